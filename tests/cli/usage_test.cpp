// What the command line says of itself and of what it does not understand.
#include "tests/support/quell_command.h"

namespace quell::test {
namespace {

class Usage : public QuellCommand {};

TEST_F(Usage, HelpHasExamplesAndTheExitCodes) {
  const auto help = quell({"--help"});
  EXPECT_EQ(help.exit, 0);
  EXPECT_EQ(help.err, "");
  for (const char* word :
       {"run", "check", "plan", "Examples:", "Exit codes:", "130 interrupted", "QUELL_PLUGINS", "QUELL_GRAPHS"})
    EXPECT_NE(help.out.find(word), std::string::npos) << word;
  EXPECT_EQ(quell({"help"}).out, help.out);
  EXPECT_EQ(quell({"-h"}).out, help.out);
}

TEST_F(Usage, EachSubcommandHasHelpWithAnExample) {
  for (const char* name : {"run", "check", "plan", "nodes", "graph", "bench"}) {
    const auto help = quell({name, "--help"});
    EXPECT_EQ(help.exit, 0) << name;
    EXPECT_EQ(help.err, "") << name;
    EXPECT_NE(help.out.find(std::string("  quell ") + name), std::string::npos) << name << " has no example";
    EXPECT_EQ(quell({"help", name}).out, help.out);
  }
}

TEST_F(Usage, Version) {
  const auto version = quell({"--version"});
  EXPECT_EQ(version.exit, 0);
  EXPECT_EQ(version.out.substr(0, 6), "quell ");
  EXPECT_EQ(version.err, "");
}

struct Mistake {
  const char* name;
  std::vector<std::string> args;
  int exit;
  std::vector<std::string> says;  // parts of stderr
};

class Mistakes : public QuellCommand, public testing::WithParamInterface<Mistake> {};

TEST_P(Mistakes, AreExplainedOnStderr) {
  const auto& m = GetParam();
  const auto r = quell(m.args);
  EXPECT_EQ(r.exit, m.exit) << r.err;
  EXPECT_EQ(r.out, "") << "messages are for people";
  for (const auto& part : m.says) EXPECT_NE(r.err.find(part), std::string::npos) << part << "\nin\n" << r.err;
  EXPECT_EQ(r.err.find("terminate"), std::string::npos) << r.err;
  EXPECT_TRUE(files().empty()) << "nothing is written";
}

std::vector<Mistake> mistakes() {
  const auto room = [](const std::vector<std::string>& more) {
    return std::vector<std::string>{"run", "svgf"} + kSmallRoom + more;
  };
  return {
      {"NoSubcommand", {}, 2, {"quell: error: A subcommand is required", "usage: quell SUBCOMMAND"}},
      {"UnknownSubcommand", {"rnu"}, 2, {"there is no subcommand 'rnu'", "Did you mean 'run'?"}},
      {"UnknownSubcommandHelp", {"help", "plna"}, 2, {"there is no subcommand 'plna'", "Did you mean 'plan'?"}},
      {"NothingGiven", {"run"}, 2, {"quell run: error: GRAPH and SEQUENCE missing", "usage: quell run GRAPH SEQUENCE"}},
      {"NoSequence", {"run", "svgf"}, 2, {"quell run: error: SEQUENCE missing"}},
      {"NoGraph", {"check"}, 2, {"quell check: error: GRAPH missing", "usage: quell check GRAPH [SEQUENCE]"}},
      {"OneTooMany", {"run", "svgf", "room", "extra"}, 2, {"'extra' is one argument too many"}},
      {"UnknownOption", room({"--framse", "0-3"}), 2, {"there is no option '--framse'. Did you mean '--frames'?"}},
      {"UnknownOptionWithValue", room({"--thread=2"}), 2, {"there is no option '--thread'. Did you mean '--threads'?"}},
      {"OptionWithoutValue", room({"--set"}), 2, {"--set: 1 required NAME=VALUE missing"}},
      {"UnknownGraph",
       {"run", "svgff", "room"},
       2,
       {"there is no graph 'svgff'", "installed are: ", "games202", "Did you mean 'svgf'?"}},
      {"UnknownSequence",
       {"run", "svgf", "rom"},
       2,
       {"there is no sequence 'rom'", "built in are: arcade, hall, room, yard, yard_undeclared",
        "Did you mean 'room'?"}},
      {"UnknownMetric", {"metrics", "flp"}, 2, {"there is no metric 'flp'", "Did you mean 'flip'?"}},
      {"NoMetric", {"metrics", "quell:svgf.json"}, 2, {"is no metric: it lacks \"metric\""}},
      {"UnknownBoth", {"run", "svgff", "rom"}, 2, {"there is no graph 'svgff'", "there is no sequence 'rom'"}},
      {"MissingGraphFile", {"check", "no.json"}, 2, {"cannot read 'no.json': No such file"}},
      {"MissingSequenceFile", {"run", "svgf", "no.json"}, 3, {"cannot read 'no.json': No such file"}},
      {"MissingImages", {"run", "svgf", "no.####.exr"}, 3, {"no file is called 'no.####.exr'"}},
      {"MalformedFrames",
       {"run", "svgf", "room", "--frames", "1-"},
       2,
       {"--frames: error: '1-' is no frame range", "first-last"}},
      {"NoFrames", {"run", "svgf", "room", "--frames", ""}, 2, {"--frames: is empty"}},
      {"GoesOnAndBeginsAnew", {"ablate", "svgf", "--resume", "--restart"}, 2, {"--resume excludes --restart"}},
      {"TunesOnAndBeginsAnew", {"tune", "t.json", "--resume", "--restart"}, 2, {"--resume excludes --restart"}},
      {"StudyIntoNoFolder", {"ablate", "svgf", "-o", ""}, 2, {"--output: is empty"}},
      {"TuningIntoNoFolder", {"tune", "t.json", "-o", ""}, 2, {"--output: is empty"}},
      {"FailuresIntoNoFolder", {"test", "s.json", "--failures", ""}, 2, {"--failures: is empty"}},
      {"EmptyFrames", {"run", "svgf", "room", "--frames", ","}, 2, {"--frames: error: '' is no frame range"}},
      {"FrameTwice", {"run", "svgf", "room", "--frames", "1-3,2"}, 2, {"'1-3,2' names frame 2 twice"}},
      {"TooManyFrames", {"run", "svgf", "room", "--frames", "0-99999999"}, 2, {"more than 10000000 frames"}},
      {"RootIsNotThere", {"run", "svgf", "room", "--root", "no"}, 3, {"--root no: there is no such folder"}},
      {"RootOfASource",
       {"run", "svgf", "room", "--root", "."},
       2,
       {"--root .: this sequence is made by a source node"}},
      {"UnknownPolicy",
       room({"--missing", "blak"}),
       2,
       {"--missing: 'blak'", "it takes: error, skip, hold, black. Did you mean 'black'?"}},
      {"UnknownCompression", room({"--compression", "zop"}), 2, {"--compression: 'zop'", "Did you mean 'zip'?"}},
      {"UnknownProgress", room({"--progress", "jsno"}), 2, {"--progress: 'jsno'", "Did you mean 'json'?"}},
      {"UnknownSimd", room({"--simd", "avx9"}), 2, {"--simd: 'avx9'", "it takes: auto, scalar, sse4, avx2, avx512"}},
      {"ThreadsAreNoNumber", room({"--threads", "two"}), 2, {"--threads: Value two not in range 0 to 1024"}},
      {"ThreadsAreNegative", room({"--threads", "-1"}), 2, {"--threads"}},
      {"BandRowsAreNegative", room({"--band-rows=-1"}), 2, {"--band-rows"}},
      {"UnknownSourceParameter",
       room({"--source", "widht=3"}),
       2,
       {"--source #3: error: widht: node type 'path_tracer' has no parameter 'widht'", "Did you mean 'width'?"}},
      {"SourceOutOfRange",
       room({"--source", "width=0"}),
       2,
       {"--source #3: error: width: 0 is not a whole number from 1 to", "Width of the image"}},
      {"SourceOfWrongKind",
       room({"--source", "width=wide"}),
       2,
       {"--source #3: error: width: \"wide\" is not a whole number"}},
      {"SourceWithoutValue", room({"--source", "width"}), 2, {"--source width: expected NAME=VALUE"}},
      {"SourceOfUnknownScene", room({"--source", "scene=no.json"}), 2, {"there is no file \"no.json\""}},
      {"PluginFolderIsNotThere", room({"--plugins", "no"}), 4, {"--plugins no: there is no such folder"}},
      {"TooLittleMemory", room({"--max-memory", "0.0001"}), 5, {"the limit is 104.9 KiB", "--max-memory"}},
      {"MemoryIsNegative", room({"--max-memory", "-1"}), 2, {"--max-memory"}},
      {"OneFileForAllFrames",
       room({"-o", "color.exr"}),
       2,
       {"-o color.exr: every frame would go to this one file", "####"}},
      {"UnknownOutput",
       room({"-o", "colour=c.####.exr"}),
       2,
       {"the graph has no output 'colour'", "Did you mean 'color'?"}},
      {"OutputTwice", room({"-o", "a.####.exr", "-o", "b.####.exr"}), 2, {"output 'color' already goes to a.####.exr"}},
      {"OutputWithoutName", room({"-o", "color="}), 2, {"-o 'color=': names no file"}},
      {"UnknownFormat", room({"-o", "c.####.jpg"}), 2, {"cannot write 'c.####.jpg'", "must end in .exr or .png"}},
      {"TwoOutputsToOneFile",
       room({"--tap", "blend.image", "-o", "c.####.exr", "-o", "blend.image=./c.%04d.exr"}),
       2,
       {"output 'color' and output 'blend.image' would both be ./c.%04d.exr"}},
      {"PreviewOverAnOutput",
       room({"--tap", "blend.image", "--preview", "-o", "c.####.exr", "-o", "blend.image=c.####.png"}),
       2,
       {"output 'blend.image' and the preview of 'color' would both be c.####.png"}},
      {"UnknownDrawing", {"graph", "svgf", "--format", "sgv"}, 2, {"--format: 'sgv'", "Did you mean 'svg'?"}},
      {"NodeByAnotherName",
       {"nodes", "box"},
       2,
       {"there is no node type 'box'", "'box' is a value of atrous.kernel, gaussian.kernel"}},
      {"NodeByItsPaper", {"nodes", "bilateral"}, 2, {"'bilateral' is spoken of in", "color_weight", "window"}},
      {"UnknownNode", {"nodes", "atruos"}, 2, {"there is no node type 'atruos'", "Did you mean 'atrous'?"}},
      {"SizeIsNoSize", {"plan", "svgf", "--size", "big"}, 2, {"--size big: expected WIDTHxHEIGHT", "1920x1080"}},
      {"SizeIsZero", {"plan", "svgf", "--size", "0x5"}, 2, {"--size 0x5"}},
      {"SizeIsHuge", {"plan", "svgf", "--size", "99999999999x5"}, 2, {"--size 99999999999x5"}},
  };
}

INSTANTIATE_TEST_SUITE_P(Usage, Mistakes, testing::ValuesIn(mistakes()),
                         [](const auto& test) { return std::string(test.param.name); });

TEST_F(Usage, OptionsMayStandBeforeWhatTheyAreFor) {
  const auto behind = quell({"plan", "svgf", "--set", "alpha=0.3", "--bypass", "demodulate", "--set", "power=2"});
  ASSERT_EQ(behind.exit, 0) << behind.err;
  EXPECT_EQ(quell({"plan", "--set", "alpha=0.3", "--set", "power=2", "--bypass", "demodulate", "svgf"}).out,
            behind.out);
  const auto all = quell(
      {"run", "--source", "width=16", "--source", "height=9", "--set", "alpha=0.3", "svgf", "room", "--frames", "0"});
  EXPECT_EQ(all.exit, 0) << all.err;
}

TEST_F(Usage, SourceParametersBelongToSources) {
  write_color("c.0001.exr", 8, 8, 1);
  write("s.json", R"({"quell_sequence": 1, "inputs": {"color": {"file": "c.####.exr"}}})");
  const auto r = quell({"run", "unfiltered", "s.json", "--source", "width=3"});
  EXPECT_EQ(r.exit, 2);
  EXPECT_NE(r.err.find("--source width=3: this sequence is made of files"), std::string::npos) << r.err;
}

TEST_F(Usage, AFullStandardOutputIsAnError) {
  for (const auto& args :
       std::vector<std::vector<std::string>>{{"plan", "svgf"}, {"check", "svgf"}, {"check", "svgf", "--json"}}) {
    const auto r = quell(args, {.out = "/dev/full"});
    EXPECT_EQ(r.exit, 5) << args[0];
    EXPECT_NE(r.err.find("No space left on device"), std::string::npos) << r.err;
  }
}

TEST_F(Usage, PrintsNoColour) {
  for (const auto& args : std::vector<std::vector<std::string>>{{"check", "svgff"}, {"plan", "svgf"}, {"--help"}}) {
    const auto r = quell(args, {.environment = {{"CLICOLOR_FORCE", "1"}}});
    EXPECT_EQ((r.out + r.err).find('\033'), std::string::npos);
  }
}

}  // namespace
}  // namespace quell::test
