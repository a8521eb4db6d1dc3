// History on disk: a run goes on where another ended, and what does not fit is refused.
#include "core/run/executor.h"

#include "tests/support/accumulator.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace quell::test {
namespace {

class State : public testing::Test {
 protected:
  std::filesystem::path path_ = std::filesystem::temp_directory_path() / ("quell_state_" + std::to_string(getpid()));
  void TearDown() override { std::filesystem::remove(path_); }
  RunOptions saving() { return {.save_state = path_}; }
  RunOptions loading() { return {.load_state = path_}; }
  std::string failure(const Graph& g, Frames source) {
    Keep sink;
    try {
      run_graph(g, source, sink, loading());
    } catch (const Error& e) {
      return e.what();
    }
    return "";
  }
};

TEST_F(State, AChunkedRunGivesTheSameBits) {
  Graph g = accumulator();
  g.nodes[0] = make("total", "sum", {{{input(), 2, {}}}, {{{0, 0}, 3, {}}}});
  Keep whole, first, second;
  Frames all(0, 9), a(0, 4), b(5, 9);
  run_graph(g, all, whole, {});
  run_graph(g, a, first, saving());
  EXPECT_EQ(run_graph(g, b, second, loading()).resets, 0u);
  for (std::size_t f = 0; f < 10; ++f)
    for (std::size_t o = 0; o < 2; ++o)
      EXPECT_TRUE(same(whole.frames[f].second[o], (f < 5 ? first.frames[f] : second.frames[f - 5]).second[o])) << f;
}

TEST_F(State, AShortPastStaysShort) {
  Graph g = accumulator();
  g.nodes[0] = make("total", "sum", {{{input(), 0, {}}}, {{{0, 0}, 3, {}}}});
  Keep whole, sink, rest;
  Frames all(0, 3), a(0, 0), b(1, 3);
  run_graph(g, all, whole, {});
  run_graph(g, a, sink, saving());
  run_graph(g, b, rest, loading());
  for (std::size_t f = 1; f < 4; ++f) EXPECT_TRUE(same(whole.frames[f].second[1], rest.frames[f - 1].second[1])) << f;
}

TEST_F(State, RefusesWhatDoesNotFit) {
  Keep sink;
  Frames a(0, 4);
  run_graph(accumulator(), a, sink, saving());
  const std::string name = path_.string();
  EXPECT_EQ(failure(accumulator(), Frames(7, 9)),
            name + ": cannot load state: it was saved after frame 4, so a run must go on with frame 5, not 7");
  Frames wide(5, 9);
  wide.width = 20;
  EXPECT_EQ(failure(accumulator(), wide),
            name + ": cannot load state: 'total.sum' was 37x101 with 1 channels, now 20x101 with 1");
  Graph other = accumulator();
  other.nodes.push_back(make("blur", "blur", {{{{0, 0}, 0, {}}}}));
  EXPECT_NE(failure(other, Frames(5, 9)).find("it was saved by another graph"), std::string::npos);

  const auto size = std::filesystem::file_size(path_);
  {
    std::fstream file(path_, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(std::streamoff(size / 2));
    file.put('x');
  }
  EXPECT_EQ(failure(accumulator(), Frames(5, 9)),
            name + ": cannot load state: its checksum does not fit; save it anew");
  std::filesystem::resize_file(path_, size / 2);
  EXPECT_EQ(failure(accumulator(), Frames(5, 9)), name + ": cannot load state: it ends too early; save it anew");
  std::filesystem::remove(path_);
  EXPECT_EQ(failure(accumulator(), Frames(5, 9)), name + ": cannot load state: No such file or directory");
}

TEST_F(State, RefusesCountsThatCannotBeCountedOn) {
  Keep sink;
  Frames a(0, 4);
  run_graph(accumulator(), a, sink, saving());
  // Behind the magic and the fingerprint: the frame, then the age.
  for (const auto& [offset, value] :
       {std::pair<int, std::int64_t>{24, INT64_MAX}, {32, INT64_MAX}, {32, 0}, {32, -1}}) {
    Frames first(0, 4);
    run_graph(accumulator(), first, sink, saving());
    std::fstream file(path_, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(offset);
    file.write(reinterpret_cast<const char*>(&value), sizeof value);
    file.close();
    EXPECT_EQ(failure(accumulator(), Frames(5, 9)), path_.string() + ": cannot load state: it is damaged; save it anew")
        << offset << ": " << value;
  }
}

// In a folder that others may write to, a name that can be foretold may be a link that they made.
TEST_F(State, IsWrittenToNoNameThatCanBeForetold) {
  const auto victim = path_.string() + ".victim", link = path_.string() + ".tmp" + std::to_string(getpid());
  std::ofstream(victim) << "mine";
  std::filesystem::create_symlink(victim, link);
  Keep sink;
  Frames a(0, 4);
  run_graph(accumulator(), a, sink, saving());
  std::string text;
  std::ifstream(victim) >> text;
  EXPECT_EQ(text, "mine");
  std::filesystem::remove(link);
  std::filesystem::remove(victim);
}

}  // namespace
}  // namespace quell::test
