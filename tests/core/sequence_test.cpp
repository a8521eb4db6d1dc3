// Sequences of files: which frames there are, how their files are recognised, and what happens when some are missing.
#include "core/sequence/sequence.h"

#include "core/report/error.h"
#include "core/sequence/profile.h"
#include "tests/support/failure.h"
#include "tests/support/run_node.h"
#include "tests/support/sequence_test.h"

#include <quell/types.h>

#include <cmath>
#include <cstdlib>
#include <limits>

namespace quell::test {
namespace {

using Frames = std::vector<std::int64_t>;

const std::vector<std::pair<std::string, float>> kColor = {{"R", 1.0f}, {"G", 2.0f}, {"B", 3.0f}};

TEST_F(SequenceTest, FindsItsFramesOnTheDisk) {
  for (const char* name : {"c_1.exr", "c_2.exr", "c_10.exr"}) write(name, 4, 3, kColor);
  const auto source = open(load(R"({"quell_sequence": 1, "inputs": {"color": "c_@.exr"}})"));
  EXPECT_EQ(source->frames(), (Frames{1, 2, 10}));
  EXPECT_EQ(source->roles(), (std::map<std::string, int>{{"color", QUELL_RADIANCE}}));
  EXPECT_EQ(read_role(*source, 2, "color").at(2, 3, 2), 3.0f);
}

TEST_F(SequenceTest, CutsAreDeclaredOrGaps) {
  for (int i = 1; i <= 8; ++i) write("c_" + std::to_string(i) + ".exr", 2, 2, kColor);
  const auto source =
      open(load(R"({"quell_sequence": 1, "frames": "1-3,5-8", "cuts": [7], "inputs": {"color": "c_@.exr"}})"));
  Frames cuts;
  for (const auto frame : source->frames())
    if (source->cut_before(frame)) cuts.push_back(frame);
  EXPECT_EQ(cuts, (Frames{1, 5, 7}));
  EXPECT_TRUE(source->declared_cut(7));
  EXPECT_FALSE(source->declared_cut(5));
  const auto backwards = open(load(R"({"quell_sequence": 1, "frames": "3-1", "inputs": {"color": "c_@.exr"}})"));
  EXPECT_TRUE(backwards->cut_before(2));
}

TEST_F(SequenceTest, TheCommandLineChoosesFramesAndRoot) {
  std::filesystem::create_directory(path("elsewhere"));
  for (int i = 0; i < 4; ++i) write("elsewhere/c_" + std::to_string(i) + ".exr", 2, 2, kColor);
  std::ofstream(path("s.json"))
      << R"({"quell_sequence": 1, "root": "nowhere", "frames": "0-3", "inputs": {"color": "c_@.exr"}})";
  Diagnostics diagnostics;
  const auto sequence = load_sequence({path("s.json"), "2-3", path("elsewhere"), profiles()}, diagnostics);
  ASSERT_TRUE(sequence) << diagnostics.format();
  EXPECT_EQ(open(*sequence)->frames(), (Frames{2, 3}));
  EXPECT_FALSE(load_sequence({path("s.json"), "2-", {}, profiles()}, diagnostics));
  EXPECT_EQ(
      diagnostics.format(),
      "--frames: error: '2-' is no frame range: write a frame, first-last or first-lastxstep, with commas between\n");
}

TEST_F(SequenceTest, NamesAMissingFrameAndItsFile) {
  for (const int i : {0, 1, 3, 5}) write("c_" + std::to_string(i) + ".exr", 2, 2, kColor);
  const auto sequence = load(R"({"quell_sequence": 1, "frames": "0-5", "inputs": {"color": "c_@.exr"}})");
  EXPECT_EQ(failure(Exit::input, [&] { open(sequence); }),
            "frame 2: color: " + path("c_2.exr") + ": there is no such file\n  frames without all their files: 2,4");
  const auto none = load(R"({"quell_sequence": 1, "frames": "7-8", "inputs": {"color": "c_@.exr"}})");
  EXPECT_EQ(failure(Exit::input, [&] { open(none, Missing::hold); }),
            "frame 7: color: " + path("c_7.exr") + ": there is no such file\n  frames without all their files: 7-8");
}

TEST_F(SequenceTest, GoesOnWithoutMissingFrames) {
  for (const int i : {0, 1, 3, 4})
    write("c_" + std::to_string(i) + ".exr", 2, 2, {{"R", float(i)}, {"G", 0}, {"B", 0}});
  for (int i = 0; i < 5; ++i) write("z_" + std::to_string(i) + ".exr", 2, 2, {{"Z", 10.0f + float(i)}});
  const auto sequence =
      load(R"({"quell_sequence": 1, "frames": "0-4", "inputs": {"color": "c_@.exr", "depth": "z_@.exr"}})");

  const auto skip = open(sequence, Missing::skip);
  EXPECT_EQ(skip->frames(), (Frames{0, 1, 3, 4}));
  EXPECT_TRUE(skip->cut_before(3));
  EXPECT_FALSE(skip->cut_before(4));

  const auto hold = open(sequence, Missing::hold);
  EXPECT_EQ(hold->frames(), (Frames{0, 1, 2, 3, 4}));
  EXPECT_FALSE(hold->cut_before(2));
  EXPECT_EQ(read_role(*hold, 2, "color").at(0, 0, 0), 1.0f);
  EXPECT_EQ(read_role(*hold, 2, "depth").at(0, 0, 0), 12.0f);

  const auto black = open(sequence, Missing::black);
  EXPECT_EQ(black->frames(), (Frames{0, 1, 2, 3, 4}));
  EXPECT_TRUE(black->cut_before(2));
  EXPECT_TRUE(black->cut_before(3));
  EXPECT_FALSE(black->cut_before(4));
  EXPECT_EQ(read_role(*black, 2, "color").at(0, 0, 0), 0.0f);
  EXPECT_EQ(read_role(*black, 2, "depth").at(0, 0, 0), kFar);
  EXPECT_EQ(black->missing_frames(), Frames{2});

  // What no graph reads need not be there.
  EXPECT_EQ(open(sequence, Missing::error, {"depth"})->frames().size(), 5u);
}

TEST_F(SequenceTest, NamesChannelsThatAreNotThere) {
  write("c_0.exr", 2, 2, {{"Layer.Deep.Z", 1}, {"Layer.Depth.Z", 1}, {"R", 1}});
  const auto text = failure(Exit::input, [&] {
    open(load(
        R"({"quell_sequence": 1, "inputs": {"depth": {"file": "c_@.exr", "channels": ["Layer.Depht.Z"]}, "color": "c_@.exr"}})"));
  });
  EXPECT_EQ(text, path("sequence.json") + ":1:75: error: inputs.depth: '" + path("c_0.exr") +
                      "' has no channel 'Layer.Depht.Z'\n  it has: R, Layer.Deep.Z, Layer.Depth.Z. Did you mean "
                      "'Layer.Depth.Z'?\n" +
                      path("sequence.json") + ":1:104: error: inputs.color: '" + path("c_0.exr") +
                      "' has no channels by the usual names of radiance\n  usual names: R G B, r g b, Y alone\n"
                      "  it has: R, Layer.Deep.Z, Layer.Depth.Z\n  name them with \"channels\"\n");
}

TEST_F(SequenceTest, NamesAFrameThatCannotBeRead) {
  write("c_0.exr", 40, 30, kColor);
  write("c_1.exr", 40, 30, {{"R", 1}, {"G", 2}, {"b", 3}});
  std::filesystem::copy(path("c_0.exr"), path("c_2.exr"));
  std::filesystem::resize_file(path("c_2.exr"), std::filesystem::file_size(path("c_2.exr")) - 9);
  const auto source = open(load(R"({"quell_sequence": 1, "frames": "0-2", "inputs": {"color": "c_@.exr"}})"));
  EXPECT_EQ(failure(Exit::input, [&] { read_role(*source, 1, "color"); }),
            "frame 1: " + path("c_1.exr") +
                ": has no channel 'B', unlike the first frame\n  it has: R, G, b. Did you mean 'b'?");
  EXPECT_TRUE(failure(Exit::input, [&] {
                read_role(*source, 2, "color");
              }).starts_with("frame 2: " + path("c_2.exr") + ": cannot be read: "));
  EXPECT_EQ(read_role(*source, 0, "color").at(1, 39, 29), 2.0f);
}

TEST_F(SequenceTest, SaysWhatShapeEachFrameHas) {
  write("c_0.exr", 4, 3, kColor);
  write("c_1.exr", 6, 5, kColor);
  const auto source = open(load(R"({"quell_sequence": 1, "inputs": {"color": "c_@.exr"}})"));
  const std::vector<std::string> roles = {"color"};
  EXPECT_EQ(source->shapes(0, roles)[0].width, 4);
  EXPECT_EQ(source->shapes(1, roles)[0].width, 6);
  EXPECT_EQ(source->shapes(1, roles)[0].height, 5);
  EXPECT_EQ(source->shapes(1, roles)[0].channels, 3);
}

TEST_F(SequenceTest, ExposesSourceNodes) {
  const auto sequence =
      load(R"({"quell_sequence": 1, "frames": "0-2", "source": {"type": "room", "set": {"spp": 2}}})");
  ASSERT_TRUE(sequence.source);
  EXPECT_EQ(sequence.source->type, "room");
  ASSERT_TRUE(sequence.source->set);
  EXPECT_EQ(sequence.source->set->find("spp")->integer, 2);
  EXPECT_EQ(sequence.frames, (Frames{0, 1, 2}));
}

TEST_F(SequenceTest, TheBuiltInSequencesHaveSourcesForFramesAndReference) {
  const auto folder = std::filesystem::path(QUELL_TEST_SOURCE) / "graphs/sequences";
  int found = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    const Sequence sequence = load_path(file.path().string());
    ASSERT_TRUE(sequence.source) << file.path();
    ASSERT_EQ(sequence.reference_sources.size(), 2u) << file.path();
    EXPECT_EQ(sequence.source->type, "path_tracer");
    EXPECT_EQ(sequence.reference_sources[0].role, "reference_a");
    EXPECT_EQ(sequence.reference_sources[1].role, "reference_b");
    const auto seed = [](const SourceNode& node) {
      const Json* j = node.set->find("seed");
      return j ? j->integer : 0;
    };
    EXPECT_NE(seed(sequence.reference_sources[0].node), seed(sequence.reference_sources[1].node));
    for (const auto& half : sequence.reference_sources) {
      EXPECT_NE(seed(half.node), seed(*sequence.source)) << "the noise of the frames must not be in their reference";
      EXPECT_EQ(half.node.set->find("spp")->integer, 512);
    }
    EXPECT_GE(sequence.frames.size(), 16u);
    ++found;
  }
  EXPECT_GE(found, 5);
}

TEST_F(SequenceTest, ReadsReferencesWhereThereAreSome) {
  for (int i = 0; i < 4; ++i) write("c_" + std::to_string(i) + ".exr", 2, 2, kColor);
  for (const char* half : {"a", "b"})
    write("ref_2_" + std::string(half) + ".exr", 2, 2, {{"R", 7}, {"G", 8}, {"B", 9}});
  const auto source = open(load(R"({"quell_sequence": 1, "inputs": {"color": "c_@.exr"},
                                    "reference": {"A": "ref_@_a.exr", "B": "ref_@_b.exr"}})"));
  EXPECT_EQ(source->reference_frames(), Frames{2});
  EXPECT_EQ(read_role(*source, 2, "reference_b").at(2, 0, 0), 9.0f);
  EXPECT_EQ(source->frames().size(), 4u);
}

TEST_F(SequenceTest, RecognisesALoneImage) {
  for (int i = 1; i <= 2; ++i) {
    write("r." + std::string("000") + std::to_string(i) + ".exr", 3, 2,
          {{"View Layer.Combined.R", 1},
           {"View Layer.Combined.G", 2},
           {"View Layer.Combined.B", 3},
           {"View Layer.Depth.Z", 1e10f},
           {"View Layer.Vector.X", 5},
           {"View Layer.Vector.Y", 6},
           {"View Layer.Denoising Normal.X", 1},
           {"View Layer.Denoising Normal.Y", 0},
           {"View Layer.Denoising Normal.Z", 0}});
  }
  const auto source = open(load_path(path("r.####.exr")));
  EXPECT_EQ(source->frames(), (Frames{1, 2}));
  // The normal is in camera space, and there is no camera.
  EXPECT_EQ(source->roles(),
            (std::map<std::string, int>{{"color", QUELL_RADIANCE}, {"depth", QUELL_DEPTH}, {"motion", QUELL_MOTION}}));
  EXPECT_EQ(read_role(*source, 1, "motion").at(1, 0, 0), -6.0f);
  EXPECT_EQ(read_role(*source, 1, "depth").at(0, 0, 0), kFar);
}

TEST_F(SequenceTest, ListsWhatAnUnknownImageHas) {
  write("r.0001.exr", 3, 2, {{"left.one", 1}, {"left.two", 1}});
  EXPECT_EQ(
      failure(Exit::input, [&] { load_path(path("r.####.exr")); }),
      "error: no profile knows the channels of '" + path("r.0001.exr") +
          "'\n  it has: left.one, left.two\n  profiles tried: bmfr, cycles, falcor, games202, mitsuba, pbrt, plain\n"
          "  a sequence file can say which channel plays which role\n");
  EXPECT_EQ(failure(Exit::input, [&] { load_path(path("none.####.exr")); }),
            "no file is called '" + path("none.####.exr") + "'");
}

TEST_F(SequenceTest, RecognisesAFolder) {
  for (int i = 0; i < 2; ++i) {
    write("beauty_" + std::to_string(i) + ".exr", 3, 2, kColor);
    write_camera("matrix_" + std::to_string(i) + ".mat");
  }
  const auto source = open(load_path(scratch_.folder()));
  EXPECT_EQ(source->frames(), (Frames{0, 1}));
  EXPECT_EQ(source->roles(),
            (std::map<std::string, int>{
                {"camera", QUELL_CAMERA}, {"color", QUELL_RADIANCE}, {"transforms", QUELL_TRANSFORMS}}));
}

TEST_F(SequenceTest, LaysADocumentOverAProfile) {
  write("mvec.0.exr", 8, 4, {{"R", 0.25f}, {"G", 0.5f}});
  const auto value = [&](const std::string& keys) {
    const auto source = open(load(
        R"({"quell_sequence": 1, "profile": "falcor", "inputs": {"motion": {"file": "mvec.@.exr")" + keys + "}}}"));
    return read_role(*source, 0, "motion").at(0, 0, 0);
  };
  EXPECT_EQ(value(""), 2.0f);  // Falcor's fractions of the width
  EXPECT_EQ(value(R"(, "scale": 4)"), 1.0f);
  EXPECT_EQ(value(R"(, "channels": ["G", "R"])"), 0.5f);
}

TEST(Profiles, AreWithoutMistakes) {
  const std::filesystem::path folder = std::filesystem::path(QUELL_TEST_SOURCE) / "graphs/profiles";
  const auto names = profile_names(folder);
  EXPECT_GE(names.size(), 7u);
  for (const auto& name : names) {
    Diagnostics diagnostics;
    const auto profile = load_profile(folder, name, diagnostics);
    ASSERT_TRUE(profile) << diagnostics.format();
    EXPECT_FALSE(profile->about.empty() || profile->inputs.empty()) << name;
  }
}

}  // namespace
}  // namespace quell::test
