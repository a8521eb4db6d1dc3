// A folder with files of a sequence, and the ways to it.
#pragma once

#include "core/image/image.h"
#include "core/sequence/sequence.h"
#include "tests/support/paths.h"
#include "tests/support/read_role.h"
#include "tests/support/scratch.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace quell::test {

class SequenceTest : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return scratch_.path(name); }

  using Channels = std::vector<std::pair<std::string, float>>;

  // An image with the same value in all of a channel.
  void write(const std::string& name, int width, int height, const Channels& channels) {
    std::vector<std::vector<float>> planes;
    for (const auto& [channel, value] : channels) planes.emplace_back(std::size_t(width) * std::size_t(height), value);
    write_planes(name, width, height, channels, planes);
  }
  // An image with channels by these names (their values are of no meaning here) and the planes' values.
  void write_planes(const std::string& name, int width, int height, const Channels& channels,
                    const std::vector<std::vector<float>>& planes) {
    OIIO::ImageSpec spec(width, height, int(channels.size()), OIIO::TypeDesc::FLOAT);
    spec.channelnames.clear();
    for (const auto& [channel, value] : channels) spec.channelnames.push_back(channel);
    std::vector<float> pixels;
    for (std::size_t i = 0; i < planes[0].size(); ++i)
      for (const auto& plane : planes) pixels.push_back(plane[i]);
    auto out = OIIO::ImageOutput::create("openexr");
    ASSERT_TRUE(out->open(path(name), spec) && out->write_image(OIIO::TypeDesc::FLOAT, pixels.data()) && out->close());
  }

  // A camera at (1, 2, 3) that looks along world +x with y up, and projects as a pinhole of focal length 10 pixels.
  void write_camera(const std::string& name) {
    const float view[16] = {0, 0, -1, 3, 0, 1, 0, -2, 1, 0, 0, -1, 0, 0, 0, 1};
    const float pinhole[16] = {10, 0, 8, 0, 0, -10, 6, 0, 0, 0, 1, -0.1f, 0, 0, 1, 0};
    float screen[16] = {};
    for (int r = 0; r < 4; ++r)
      for (int c = 0; c < 4; ++c)
        for (int k = 0; k < 4; ++k) screen[4 * r + c] += pinhole[4 * r + k] * view[4 * k + c];
    const std::int32_t n = 0;
    std::ofstream out(path(name), std::ios::binary);
    out.write(reinterpret_cast<const char*>(&n), 4)
        .write(reinterpret_cast<const char*>(view), 64)
        .write(reinterpret_cast<const char*>(screen), 64);
  }

  Sequence load(const std::string& json, std::optional<std::string> frames = {}) {
    std::ofstream(path("sequence.json")) << json;
    return load_path(path("sequence.json"), std::move(frames));
  }
  Sequence load_path(const std::string& file, std::optional<std::string> frames = {}) {
    SequenceRequest request{file, std::move(frames), {}, profiles()};
    auto sequence = load_sequence(request, diagnostics_);
    if (!sequence) throw std::runtime_error(diagnostics_.format());
    return std::move(*sequence);
  }
  std::unique_ptr<FileSequence> open(const Sequence& sequence, Missing missing = Missing::error,
                                     const std::vector<std::string>& roles = {}) {
    auto source = open_sequence(sequence, roles, missing, diagnostics_);
    if (!source) throw std::runtime_error(diagnostics_.format());
    return source;
  }
  static std::filesystem::path profiles() { return std::filesystem::path(QUELL_TEST_SOURCE) / "graphs/profiles"; }

  Scratch scratch_;
  Diagnostics diagnostics_;
};

}  // namespace quell::test
