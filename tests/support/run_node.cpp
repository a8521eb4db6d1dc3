// Runs one node of a plugin on images.
#include "tests/support/run_node.h"
#include "tests/support/paths.h"

#include <quell/types.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <stdexcept>

#ifdef QUELL_STATIC_PLUGIN_LIST
#define QUELL_STATIC_PLUGIN(name) extern "C" const quell_plugin_table* quell_plugin_##name(void);
#include QUELL_STATIC_PLUGIN_LIST
#undef QUELL_STATIC_PLUGIN
#endif

namespace quell::test {

namespace {

[[noreturn]] void fail(const std::string& text) { throw std::runtime_error(text); }

int port_of(const NodeType& type, std::string_view name) {
  const int i = type.find_input(name);
  if (i < 0) fail(std::string(type.name()) + " has no input " + std::string(name));
  return i;
}

float next(std::uint32_t& state) {
  state = state * 1664525u + 1013904223u;
  return float(state >> 8) * (1.0f / 16777216.0f);
}

}  // namespace

Registry& registry() {
  static Registry registry = [] {
    const char* elsewhere = std::getenv("QUELL_TEST_PLUGINS");
    Registry made({elsewhere ? elsewhere : QUELL_TEST_PLUGINS});
#ifdef QUELL_STATIC_PLUGIN_LIST
#define QUELL_STATIC_PLUGIN(name) made.add_static(quell_plugin_##name());
#include QUELL_STATIC_PLUGIN_LIST
#undef QUELL_STATIC_PLUGIN
#endif
    return made;
  }();
  return registry;
}

Node::Node(std::string_view type)
    : type_([&] {
        const auto* t = registry().find(type);
        if (!t) {
          const auto* p = registry().problem(type);
          fail("no node type " + std::string(type) + (p ? ": " + p->text : ""));
        }
        return t;
      }()),
      instance_(*type_),
      images_(type_->inputs().size()),
      weights_(type_->inputs().size()) {}

Node& Node::set(std::string_view param, ParamValue value) {
  const int i = type_->find_param(param);
  if (i < 0) fail(std::string(type_->name()) + " has no parameter " + std::string(param));
  const auto& p = type_->params()[std::size_t(i)];
  switch (p.kind) {
    case QUELL_BOOL:
      instance_.set_bool(i, std::get<bool>(value));
      break;
    case QUELL_INT:
      instance_.set_int(i, std::get<int>(value));
      break;
    case QUELL_FLOAT:
      instance_.set_float(i, std::holds_alternative<int>(value) ? float(std::get<int>(value)) : std::get<float>(value));
      break;
    case QUELL_FLOATS:
      instance_.set_floats(i, std::get<std::vector<float>>(value));
      break;
    case QUELL_CHOICE: {
      const auto& name = std::get<std::string>(value);
      int found = -1;
      for (int c = 0; c < p.choice_count; ++c)
        if (name == p.choices[c]) found = c;
      if (found < 0) fail("parameter " + std::string(param) + " has no choice " + name);
      instance_.set_int(i, found);
      break;
    }
    default:
      instance_.set_text(i, std::get<std::string>(value));
      break;
  }
  return *this;
}

Node& Node::in(std::string_view port, const Image& image) {
  images_[std::size_t(port_of(*type_, port))].push_back(image.view());
  return *this;
}
Node& Node::in_missing(std::string_view port, const Image& image) {
  in(port, image);
  images_[std::size_t(port_of(*type_, port))].back().missing = 1;
  return *this;
}
Node& Node::in(std::string_view port, Node& weight) {
  weights_[std::size_t(port_of(*type_, port))].push_back(&weight);
  return *this;
}
Node& Node::frame(std::int64_t number) {
  frame_ = number;
  return *this;
}
Node& Node::tiles(int rows, int columns) {
  rows_ = rows, columns_ = columns;
  return *this;
}

std::vector<quell_shape> Node::shapes() const {
  std::vector<quell_shape> in(images_.size());
  std::vector<int32_t> counts(images_.size()), channels(images_.size());
  quell_shape first{};
  for (std::size_t i = 0; i < images_.size(); ++i) {
    counts[i] = int(images_[i].size());
    for (const auto& image : images_[i]) channels[i] += image.channels;
    if (images_[i].empty()) continue;
    in[i] = {images_[i][0].width, images_[i][0].height, images_[i][0].channels};
    const auto* info = type_info(type_->inputs()[i].type);
    if (!first.width && (!info || info->storage == Storage::pixels)) first = in[i];
  }
  std::vector<quell_shape> out;
  for (const auto& port : type_->outputs()) {
    quell_shape s = first;
    const auto* info = type_info(port.type);
    if (info && info->channels) {
      s.channels = info->channels;
    } else {
      for (std::size_t i = images_.size(); i-- > 0;)
        if (type_->inputs()[i].type == port.type && counts[i]) s.channels = in[i].channels;
    }
    if (info && info->storage == Storage::value) s = {1, 1, 1};
    out.push_back(s);
  }
  const quell_spec spec{in.data(), counts.data(), channels.data()};
  quell_error error{};
  if (type_->table().shapes && type_->table().shapes(instance_.data(), &spec, out.data(), &error)) fail(error.text);
  return out;
}

const quell_bound_weight& Node::bound() {
  inputs_.clear();
  for (auto& list : images_) inputs_.push_back({list.data(), nullptr, int(list.size())});
  bound_ = {type_->table().weigh, instance_.data(), nullptr, inputs_.data()};
  return bound_;
}

std::vector<Image> Node::run() {
  const auto& table = type_->table();
  if (!table.run) fail("a weight node does not run");
  std::vector<std::vector<quell_bound_weight>> bound(images_.size());
  std::vector<quell_input> inputs;
  std::vector<quell_shape> in_shapes;
  std::vector<int32_t> counts, channels;
  for (std::size_t i = 0; i < images_.size(); ++i) {
    for (Node* w : weights_[i]) bound[i].push_back(w->bound());
    const bool weight = type_->inputs()[i].type == QUELL_WEIGHT;
    const auto count = int(weight ? bound[i].size() : images_[i].size());
    inputs.push_back({weight ? nullptr : images_[i].data(), weight ? bound[i].data() : nullptr, count});
    in_shapes.push_back(images_[i].empty()
                            ? quell_shape{}
                            : quell_shape{images_[i][0].width, images_[i][0].height, images_[i][0].channels});
    counts.push_back(count);
    channels.push_back(0);
    for (const auto& image : images_[i]) channels.back() += image.channels;
  }
  const auto out_shapes = shapes();
  std::vector<Image> images;
  std::vector<quell_image> out;
  for (std::size_t i = 0; i < out_shapes.size(); ++i) {
    const int with = type_->outputs()[i].with;
    const bool exists = with < 0 || counts[std::size_t(with)] > 0;
    images.push_back(exists ? Image(out_shapes[i]) : Image());
    if (exists) images.back().fill(std::nanf(""));
    out.push_back(exists ? images.back().view() : quell_image{});
  }
  quell_error error{};
  void* resource = nullptr;
  const quell_spec spec{in_shapes.data(), counts.data(), channels.data()};
  if (table.prepare && table.prepare(instance_.data(), &spec, &resource, &error)) fail(error.text);
  const std::unique_ptr<void, void (*)(void*)> kept(
      resource, table.release ? table.release : [](void*) {});
  // Tiles cover the first output that is pixels; tables and values are written by the tile that holds (0, 0).
  std::size_t tiled = 0;
  while (tiled + 1 < out.size() &&
         (!images[tiled].channels() || type_info(type_->outputs()[tiled].type) == nullptr ||
          type_info(type_->outputs()[tiled].type)->storage != Storage::pixels) &&
         type_->outputs()[tiled].type != QUELL_ANY)
    ++tiled;
  const int height = out_shapes[tiled].height, width = out_shapes[tiled].width;
  const int rows = rows_ ? rows_ : height, columns = columns_ ? columns_ : width;
  for (int y = 0; y < height; y += rows)
    for (int x = 0; x < width; x += columns) {
      const quell_tile tile{inputs.data(), out.data(), x, y, std::min(x + columns, width), std::min(y + rows, height),
                            frame_};
      if (table.run(instance_.data(), resource, &tile, &error)) fail(error.text);
    }
  return images;
}

Image Node::run(std::string_view output) {
  const int i = type_->find_output(output);
  if (i < 0) fail(std::string(type_->name()) + " has no output " + std::string(output));
  return std::move(run()[std::size_t(i)]);
}

Image noise_image(int width, int height, int channels, std::uint32_t seed, float low, float high) {
  Image image(width, height, channels);
  for (int c = 0; c < channels; ++c)
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) image.at(c, x, y) = low + (high - low) * next(seed);
  return image;
}

Image constant_image(int width, int height, int channels, float value) {
  Image image(width, height, channels);
  image.fill(value);
  return image;
}

Image normal_image(int width, int height, std::uint32_t seed, bool misses) {
  Image image(width, height, 3);
  const float phase = float(seed % 97);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float a = std::sin(float(x) * 0.11f + phase), b = std::cos(float(y) * 0.07f - phase),
                  n = std::sqrt(a * a + b * b + 1);
      const bool miss = misses && next(seed) < 0.05f;
      image.at(0, x, y) = miss ? 0 : a / n;
      image.at(1, x, y) = miss ? 0 : b / n;
      image.at(2, x, y) = miss ? 0 : 1 / n;
    }
  return image;
}

bool same_bits(const Image& a, const Image& b) {
  if (a.width() != b.width() || a.height() != b.height() || a.channels() != b.channels()) return false;
  for (int c = 0; c < a.channels(); ++c)
    for (int y = 0; y < a.height(); ++y)
      if (std::memcmp(a.row(c, y), b.row(c, y), std::size_t(a.width()) * sizeof(float))) return false;
  return true;
}

}  // namespace quell::test
