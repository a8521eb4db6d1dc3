// Sequences written and loaded again, the hashes of their files, and words for a shell.
#include "core/sequence/write.h"

#include "core/report/error.h"
#include "core/report/shell.h"
#include "core/sequence/file_hash.h"
#include "tests/support/scratch.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace quell::test {
namespace {

std::optional<Sequence> loaded(const std::string& text, Diagnostics& diagnostics) {
  SequenceRequest request;
  request.path = "/shots/12/shot.json";
  request.text = text;
  return load_sequence(request, diagnostics);
}

TEST(WriteSequence, KeepsFilesChannelsAndConversions) {
  const std::string text =
      R"({"quell_sequence":1,"frames":"1-4,7","cuts":[3],"root":"/shots/12/in","inputs":{)"
      R"("color":{"file":"beauty.####.exr","channels":["R","G","B"],"scale":0.1},)"
      R"("motion":{"file":"beauty.####.exr","channels":["V.X","V.Y"],"negate":true,"scale":"size","flip_y":true},)"
      R"("slope":{"file":"slope_@.exr","channels":["a","b"],"scale":[1.0,-0.25]},)"
      R"("depth":{"file":"/elsewhere/z_@.exr","channels":["Z"],"miss":0.0,"reciprocal":true,"distance":true},)"
      R"("normal":{"file":"n.%02d.exr","channels":["X","Y","Z"],"encoded":true,"space":"camera"},)"
      R"("position":{"file":"p.#.exr","channels":["X","Y","Z"],"miss":"camera"},)"
      R"("glow":{"file":"g.#.exr","type":"scalar","channels":["Y"]},)"
      R"("camera":{"file":"matrix_@.mat","format":"games202"}},)"
      R"("reference":{"A":{"file":"a.#.exr","channels":["R","G","B"]},"B":{"file":"b.#.exr"}}})";
  Diagnostics diagnostics;
  const auto sequence = loaded(text, diagnostics);
  ASSERT_TRUE(sequence) << diagnostics.format();
  EXPECT_EQ(write_sequence(*sequence), text);
  EXPECT_EQ(sequence->root, "/shots/12/in");
}

TEST(WriteSequence, NamesFilesBelowTheRoot) {
  EXPECT_EQ(name_below("/shots/12", "/shots/12/in/a.exr"), "in/a.exr");
  EXPECT_EQ(name_below("/shots/12", "/shots/13/a.exr"), "/shots/13/a.exr");
  EXPECT_EQ(name_below("/shots/12", "/shots/123/a.exr"), "/shots/123/a.exr");
  EXPECT_EQ(name_below("", "in/a.exr"), "in/a.exr") << "the folder that the program runs in";
}

// The first is XXH3's published value of nothing; both are what xxhsum -H3 prints.
TEST(FileHash, IsThatOfItsBytes) {
  const Scratch scratch;
  const auto file = scratch.path("a");
  std::ofstream(file) << "";
  EXPECT_EQ(file_hash(file), "2d06800538d394c2");
  const std::string large(1000003, 'q');  // several buffers
  std::ofstream(file) << large;
  EXPECT_EQ(file_hash(file), text_hash(large));
  EXPECT_NE(file_hash(file), text_hash(large + 'q'));
  EXPECT_THROW(file_hash(scratch.path("b")), Error);
  EXPECT_THROW(file_hash(scratch.folder()), Error);
}

TEST(ShellText, QuotesWhatAShellWouldRead) {
  const std::vector<std::string> words{"quell",          "run",      "a b", "", "it's", "--set", "x=$y",
                                       "out/c.####.exr", "c.%04d@-1"};
  EXPECT_EQ(shell_text(words), R"(quell run 'a b' '' 'it'\''s' --set 'x=$y' 'out/c.####.exr' c.%04d@-1)");
}

}  // namespace
}  // namespace quell::test
