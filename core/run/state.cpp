// Saves and loads the delayed buffers of a run.
//
// Layout, little-endian: "QUELLST1", fingerprint (16 characters), frame (i64), age (i64), number of images (u32); for
// each image: name (u32 length, bytes), delay, width, height, channels (i32), then its rows as 32-bit words; at the end
// FNV-1a 64 of all before it.
#include "core/run/state.h"

#include "core/report/error.h"
#include "core/sequence/temporary_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

namespace quell {

namespace fs = std::filesystem;

namespace {

constexpr char kMagic[] = "QUELLST1";
constexpr std::int64_t kMost = std::int64_t(1) << 53;

class Hash {
 public:
  void add(const void* data, std::size_t size) {
    // Words at a time: a state holds hundreds of megabytes.
    const auto* p = static_cast<const unsigned char*>(data);
    for (; size >= 8; p += 8, size -= 8) {
      std::uint64_t word;
      std::memcpy(&word, p, 8);
      mix(word);
    }
    for (; size; ++p, --size) mix(*p);
  }
  std::uint64_t value() const { return hash_; }

 private:
  void mix(std::uint64_t word) { hash_ = (hash_ ^ word) * 1099511628211u, hash_ ^= hash_ >> 29; }
  std::uint64_t hash_ = 14695981039346656037u;
};

class Writer {
 public:
  explicit Writer(TemporaryFile& file) : file_(file) {}
  void bytes(const void* data, std::size_t size) {
    put(data, size);
    hash_.add(data, size);
  }
  template <class T>
  void number(T value) {
    bytes(&value, sizeof value);
  }
  void text(const std::string& s) { number(std::uint32_t(s.size())), bytes(s.data(), s.size()); }
  void finish() {
    const auto hash = hash_.value();
    put(&hash, sizeof hash);
    file_.write(block_.data(), block_.size());
  }

 private:
  void put(const void* data, std::size_t size) {
    constexpr std::size_t full = std::size_t(1) << 20;
    const auto* p = static_cast<const char*>(data);
    block_.insert(block_.end(), p, p + size);
    if (block_.size() < full) return;
    file_.write(block_.data(), block_.size());
    block_.clear();
  }
  TemporaryFile& file_;
  std::vector<char> block_;
  Hash hash_;
};

class Reader {
 public:
  Reader(std::ifstream& in, const fs::path& path) : in_(in), path_(path) {}
  void bytes(void* data, std::size_t size) {
    if (!in_.read(static_cast<char*>(data), std::streamsize(size))) fail("it ends too early; save it anew");
    hash_.add(data, size);
  }
  template <class T>
  T number() {
    T value;
    bytes(&value, sizeof value);
    return value;
  }
  std::string text() {
    const auto size = number<std::uint32_t>();
    if (size > 4096) fail("it is damaged; save it anew");
    std::string s(size, '\0');
    bytes(s.data(), size);
    return s;
  }
  std::uint64_t hash() const { return hash_.value(); }
  [[noreturn]] void fail(const std::string& why) const {
    throw Error(Exit::input, fmt::format("{}: cannot load state: {}", path_.string(), why));
  }

 private:
  std::ifstream& in_;
  const fs::path& path_;
  Hash hash_;
};

struct Entry {
  std::size_t value;
  int delay;
};

// What the next frame reads: the session has been advanced past the last one.
std::vector<Entry> entries(const Plan& plan) {
  std::vector<Entry> list;
  for (std::size_t i = 0; i < plan.values().size(); ++i)
    for (int k = 1; k <= plan.values()[i].delay; ++k) list.push_back({i, k});
  return list;
}

}  // namespace

void save_state(const fs::path& path, const Graph& graph, const Session& session, std::int64_t frame) {
  TemporaryFile file(path.string());
  Writer w(file);
  const auto list = entries(session.plan());
  w.bytes(kMagic, 8);
  w.bytes(fingerprint(graph).data(), 16);
  w.number(frame);
  w.number(session.age());
  w.number(std::uint32_t(list.size()));
  for (const auto& [value, delay] : list) {
    const auto& v = session.plan().values()[value];
    const auto image = session.history(value, delay);
    w.text(v.name);
    for (const std::int32_t n : {delay, image.width, image.height, image.channels}) w.number(n);
    for (int c = 0; c < image.channels; ++c)
      for (int y = 0; y < image.height; ++y)
        w.bytes(image.plane[c] + y * image.pitch, std::size_t(image.width) * sizeof(float));
  }
  w.finish();
  file.commit();
}

std::int64_t load_state(const fs::path& path, const Graph& graph, Session& session) {
  std::ifstream in(path, std::ios::binary);
  Reader r(in, path);
  if (!in) r.fail(std::strerror(errno));
  if (std::error_code error; fs::is_directory(path, error)) r.fail("it is a folder");
  char magic[8], print[16];
  r.bytes(magic, 8);
  if (std::memcmp(magic, kMagic, 8)) r.fail("this is no state file of this version");
  r.bytes(print, 16);
  const std::string wanted = fingerprint(graph);
  if (wanted != std::string(print, 16))
    r.fail(fmt::format("it was saved by another graph, parameters or plugin versions (fingerprint {}, now {})",
                       std::string(print, 16), wanted));
  const auto frame = r.number<std::int64_t>();
  const auto age = r.number<std::int64_t>();
  // Both are counted on from here, so they must leave room.
  if (age < 1 || age > kMost || frame < -kMost || frame > kMost) r.fail("it is damaged; save it anew");
  const auto list = entries(session.plan());
  if (r.number<std::uint32_t>() != list.size()) r.fail("it is damaged; save it anew");
  for (const auto& [value, delay] : list) {
    const auto& v = session.plan().values()[value];
    const auto image = session.history(value, delay);
    const auto name = r.text();
    const auto saved_delay = r.number<std::int32_t>(), width = r.number<std::int32_t>(),
               height = r.number<std::int32_t>(), channels = r.number<std::int32_t>();
    if (name != v.name || saved_delay != delay) r.fail("it is damaged; save it anew");
    if (width != image.width || height != image.height || channels != image.channels)
      r.fail(fmt::format("'{}' was {}x{} with {} channels, now {}x{} with {}", v.name, width, height, channels,
                         image.width, image.height, image.channels));
    for (int c = 0; c < channels; ++c)
      for (int y = 0; y < height; ++y) r.bytes(image.plane[c] + y * image.pitch, std::size_t(width) * sizeof(float));
  }
  const auto expected = r.hash();
  if (r.number<std::uint64_t>() != expected) r.fail("its checksum does not fit; save it anew");
  session.set_age(age);
  return frame;
}

}  // namespace quell
