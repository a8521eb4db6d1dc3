// A sequence that a source node makes.
#include "core/run/node_source.h"

#include "core/report/error.h"
#include "core/run/named_files.h"
#include "core/sequence/write.h"

#include <quell/types.h>

#include <fmt/format.h>

#include <algorithm>

namespace quell {

namespace {

void release_nothing(void*) {}

}  // namespace

NodeSource::NodeSource(Instance node, std::vector<std::int64_t> frames, std::set<std::int64_t> cuts, int threads,
                       const std::atomic<bool>* cancel)
    : node_{"source", std::move(node), {}, {}, {}},
      frames_(std::move(frames)),
      cuts_(std::move(cuts)),
      workers_(threads, cancel),
      resource_(nullptr, release_nothing) {
  const auto& type = node_.type();
  const auto& table = type.table();
  node_.in.resize(type.inputs().size());
  const auto fail = [&](const std::string& why) {
    throw Error(Exit::plugin, fmt::format("source ({}): {}", table.name, why));
  };
  if (!table.run || !table.shapes) fail("this node cannot be the source of a sequence: it needs inputs");
  for (const auto& port : type.inputs())
    if (!(port.flags & (QUELL_OPTIONAL | QUELL_LIST)))
      fail(fmt::format("this node cannot be the source of a sequence: input '{}' is required", port.name));
  for (const auto& port : type.outputs()) {
    node_.out_types.push_back(port.type);
    roles_[port.name] = port.type;
    const auto* info = type_info(port.type);
    shapes_.push_back({0, 0, info ? info->channels : 0});
  }
  std::vector<quell_shape> in(type.inputs().size());
  std::vector<std::int32_t> counts(type.inputs().size());
  const quell_spec spec{in.data(), counts.data(), counts.data()};
  quell_error error{};
  if (table.shapes(node_.instance.data(), &spec, shapes_.data(), &error)) fail(error.text);
  void* resource = nullptr;
  if (table.prepare && table.prepare(node_.instance.data(), &spec, &resource, &error)) fail(error.text);
  resource_ = {resource, table.release ? table.release : release_nothing};
  unasked_.resize(shapes_.size());
}

NodeSource::~NodeSource() = default;

bool NodeSource::cut_before(std::int64_t frame) const {
  if (cuts_.contains(frame)) return true;
  const auto it = std::ranges::find(frames_, frame);
  // Motion leads to the frame before, and to no other.
  return it == frames_.begin() || it == frames_.end() || frame != it[-1] + 1;
}

std::size_t NodeSource::output(const std::string& role) const {
  const int index = node_.type().find_output(role);
  if (index < 0)
    throw Error(Exit::input, fmt::format("the source node '{}' has no output '{}'", node_.type().name(), role));
  return std::size_t(index);
}

std::vector<quell_shape> NodeSource::shapes(std::int64_t, std::span<const std::string> roles) {
  std::vector<quell_shape> shapes;
  for (const auto& role : roles) shapes.push_back(shapes_[output(role)]);
  return shapes;
}

void NodeSource::read(std::int64_t frame, std::span<const std::string> roles, std::span<const quell_image> into) {
  for (const auto& [name, hash] : hashes_) watcher_({frame, name, hash, {roles.begin(), roles.end()}});
  std::vector<quell_image> out(shapes_.size());
  for (std::size_t i = 0; i < roles.size(); ++i) out[output(roles[i])] = into[i];
  std::size_t tiled = out.size();
  for (std::size_t o = 0; o < out.size(); ++o) {
    if (!out[o].plane) {
      if (unasked_[o].empty()) unasked_[o] = Image(shapes_[o]);
      out[o] = unasked_[o].view();
    }
    const auto* info = type_info(node_.out_types[o]);
    if (tiled == out.size() && info && info->storage == Storage::pixels) tiled = o;
  }
  if (tiled == out.size()) tiled = 0;
  const std::vector<quell_input> in(node_.in.size());
  workers_.run(out[tiled].height, 16, [&](int, int y0, int y1) {
    workers_.run(node_, resource_.get(), {in.data(), out.data(), 0, y0, out[tiled].width, y1, frame});
  });
}

std::string NodeSource::description(const std::filesystem::path& graphs, std::span<const std::string>) const {
  return write_sequence(node_.instance, frames_, cuts_, graphs);
}

std::map<std::string, std::string> NodeSource::plugins(std::span<const std::string>) const {
  return {{std::string(node_.type().name()), std::string(node_.type().version())}};
}

void NodeSource::watch_files(FileWatcher watcher) {
  watcher_ = std::move(watcher);
  hashes_ = named_files(node_.name, node_.instance);
}

}  // namespace quell
