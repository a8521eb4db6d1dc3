// Typical uses of nodes, and their calls.
#include "tests/contract/use.h"

#include "tests/support/typical_input.h"

#include <quell/types.h>

#include <algorithm>
#include <stdexcept>

namespace quell::test {

bool is_pixels(int type) {
  const auto* info = type_info(type);
  return info && info->storage == Storage::pixels;
}

Use::Use(const NodeType& node, const Choices& choices) : type(&node), instance(node), missing(choices.missing) {
  std::uint32_t seed = 1;
  for (const auto& port : node.inputs()) {
    auto& p = in.emplace_back();
    const int index = int(in.size()) - 1;
    p.type = port.type == QUELL_ANY ? choices.any : port.type;
    ++seed;
    const bool wanted = choices.optional && (choices.only < 0 || choices.only == index);
    if ((port.flags & QUELL_OPTIONAL) && !wanted) continue;
    if (p.type == QUELL_WEIGHT) {
      for (const auto* weight : choices.weights) p.weights.emplace_back(*weight, choices);
      continue;
    }
    const int count = (port.flags & QUELL_LIST) ? choices.listed : 1;
    for (int i = 0; i < count; ++i)
      p.images.push_back(choices.missing
                             ? missing_input(p.type, choices.width, choices.height)
                             : typical_input(p.type, choices.width, choices.height, seed + 100 * std::uint32_t(i)));
  }
}

Use::Use(const Use& other) : type(other.type), instance(other.instance), missing(other.missing) {
  for (const auto& from : other.in) {
    auto& p = in.emplace_back();
    p.type = from.type;
    for (const auto& image : from.images) p.images.push_back(image.copy());
    for (const auto& weight : from.weights) p.weights.push_back(weight.copy());
  }
}

Use Use::copy() const { return Use(*this); }

int Use::out_type(int port) const {
  const int declared = type->outputs()[std::size_t(port)].type;
  if (declared != QUELL_ANY) return declared;
  for (std::size_t i = 0; i < in.size(); ++i)
    if (type->inputs()[i].type == QUELL_ANY) return in[i].type;
  return declared;
}

Bound::Bound(const Use& use) : use_(use) {
  views_.resize(use.in.size());
  weights_.resize(use.in.size());
  bound_weights_.resize(use.in.size());
  for (std::size_t i = 0; i < use.in.size(); ++i) {
    const auto& port = use.in[i];
    for (const auto& image : port.images) {
      views_[i].push_back(image.view());
      views_[i].back().missing = use.missing ? 1 : 0;
    }
    for (const auto& weight : port.weights) {
      const auto& w = *weights_[i].emplace_back(std::make_unique<Bound>(weight));
      bound_weights_[i].push_back({weight.type->table().weigh, weight.instance.data(), w.resource_, w.inputs_.data()});
    }
    const bool weight = port.type == QUELL_WEIGHT;
    const auto count = std::int32_t(weight ? bound_weights_[i].size() : views_[i].size());
    inputs_.push_back(
        {count && !weight ? views_[i].data() : nullptr, count && weight ? bound_weights_[i].data() : nullptr, count});
    in_shapes_.push_back(port.images.empty() ? quell_shape{} : port.images[0].shape());
    counts_.push_back(count);
    in_channels_.push_back(0);
    for (const auto& image : port.images) in_channels_.back() += image.channels();
  }
  find_shapes();
  const auto& table = use_.type->table();
  const quell_spec spec{in_shapes_.data(), counts_.data(), in_channels_.data()};
  quell_error error{};
  if (table.prepare && table.prepare(use_.instance.data(), &spec, &resource_, &error))
    throw std::runtime_error(error.text);
}

Bound::~Bound() {
  if (use_.type->table().release) use_.type->table().release(resource_);
}

void Bound::find_shapes() {
  quell_shape first{};
  for (std::size_t i = 0; i < in_shapes_.size() && !first.width; ++i)
    if (is_pixels(use_.in[i].type)) first = in_shapes_[i];
  for (std::size_t o = 0; o < use_.type->outputs().size(); ++o) {
    const auto* info = type_info(use_.out_type(int(o)));
    quell_shape s = first;
    if (info && info->channels) s.channels = info->channels;
    const auto same =
        std::ranges::find_if(use_.in, [&](const auto& p) { return p.type == QUELL_FEATURES && !p.images.empty(); });
    if (info && !info->channels && same != use_.in.end()) s.channels = same->images[0].channels();
    if (info && info->storage == Storage::value) s = {1, 1, 1};
    shapes_.push_back(s);
  }
  const quell_spec spec{in_shapes_.data(), counts_.data(), in_channels_.data()};
  quell_error error{};
  const auto& table = use_.type->table();
  if (table.shapes && table.shapes(use_.instance.data(), &spec, shapes_.data(), &error))
    throw std::runtime_error(error.text);
}

bool Bound::exists(int output) const {
  const int with = use_.type->outputs()[std::size_t(output)].with;
  return with < 0 || counts_[std::size_t(with)] > 0;
}

quell_shape Bound::extent() const {
  for (std::size_t o = 0; o < shapes_.size(); ++o)
    if (exists(int(o)) && is_pixels(use_.out_type(int(o)))) return shapes_[o];
  return shapes_.at(0);
}

void Bound::run(const Rect& r, std::int64_t frame, const std::vector<quell_image>& out) const {
  const quell_tile tile{inputs_.data(), out.data(), r.x0, r.y0, r.x1, r.y1, frame};
  quell_error error{};
  if (use_.type->table().run(use_.instance.data(), resource_, &tile, &error)) throw std::runtime_error(error.text);
}

void Bound::weigh(const quell_run& run, float* exponent) const {
  use_.type->table().weigh(use_.instance.data(), resource_, inputs_.data(), &run, exponent);
}

}  // namespace quell::test
