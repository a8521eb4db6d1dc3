// quell rerun: makes a picture again from what it says of itself, and tells whether it is the same.
#include "apps/quell/changes.h"
#include "apps/quell/command.h"
#include "apps/quell/interrupt.h"
#include "apps/quell/options.h"
#include "apps/quell/picture_difference.h"
#include "apps/quell/recorded.h"
#include "apps/quell/recorded_frames.h"

#include "core/run/executor.h"
#include "core/sequence/excerpt.h"
#include "core/sequence/file_hash.h"
#include "core/sequence/frame_range.h"
#include "core/sequence/temporary_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>

namespace quell {

namespace {

namespace fs = std::filesystem;

struct RerunArguments {
  PluginOptions plugins;
  std::string frame, output, root;
  int threads = 0;
};

// A folder for the new picture while it is compared.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "quell-rerun.XXXXXX").string();
    if (!mkdtemp(name.data())) throw Error(Exit::resources, fmt::format("cannot make a folder '{}'", name));
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code error;
    fs::remove_all(path_, error);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

// Writes one output of the last frame.
class LastFrame : public FrameSink {
 public:
  LastFrame(const Graph& graph, std::size_t output, std::int64_t last, std::string path, WriteOptions options,
            Provenance& provenance)
      : graph_(graph),
        output_(output),
        last_(last),
        path_(std::move(path)),
        options_(std::move(options)),
        provenance_(provenance) {}
  void history_begins(std::int64_t frame) override { provenance_.history_begins(frame); }
  void write(std::int64_t frame, std::span<const quell_image> outputs) override {
    auto texts = provenance_.texts(frame);
    if (frame != last_) return;
    std::istringstream words(texts["quell:history"]);
    for (std::string word; words >> word;) history.push_back(word);
    texts.insert(options_.metadata.begin(), options_.metadata.end());
    options_.metadata = std::move(texts);
    write_image(path_, outputs[output_], graph_.outputs[output_].type, options_);
  }
  std::vector<std::string> history;  // as quell:history of the last frame

 private:
  const Graph& graph_;
  std::size_t output_;
  std::int64_t last_;
  std::string path_;
  WriteOptions options_;
  Provenance& provenance_;
};

void check_output(const RerunArguments& a, const RecordedFrames& frames, const Recorded& then) {
  if (a.output.empty()) return;
  const auto whole = [](const std::string& path) { return fs::absolute(path).lexically_normal(); };
  if (fs::path(a.output).extension() != fs::path(a.frame).extension())
    throw Error(Exit::usage, fmt::format("-o {}: must end as {} does, to be compared with it", a.output, a.frame));
  if (whole(a.output) == whole(a.frame) || frames.reads(a.output, then.first, then.frame))
    throw Error(Exit::usage, fmt::format("-o {}: is a file that is read; choose another", a.output));
  check_writable(a.output);
}

void check_state(const Recorded& then) {
  if (then.state.empty()) return;
  std::error_code error;
  if (!fs::is_regular_file(then.state, error))
    throw Error(Exit::input, fmt::format("{}: the saved state that the run went on from is not there", then.state));
  if (file_hash(then.state) != then.state_hash)
    throw Error(Exit::input,
                fmt::format("{}: is not the saved state that the run went on from: it has changed since", then.state));
}

void use_simd(const std::string& name) {
  try {
    SimdOption{name}.apply();
  } catch (const Error& e) {
    throw Error(e.exit(), fmt::format("it was made with '{}', and no other instruction set gives the same bits\n  {}",
                                      name, e.what()));
  }
}

int rerun(const RerunArguments& a) {
  const auto& cancel = watch_interrupts();
  const Recorded then = read_recorded(a.frame);
  use_simd(then.simd);
  if (!missing_from_name(then.missing))
    throw Error(Exit::usage, fmt::format("{}: its attribute 'quell:missing' is '{}'", a.frame, then.missing));
  Commander commander(a.plugins);
  const auto recorded = RecordedFrames::load(commander, a.frame, then, a.root);
  GraphRequest request;
  request.graph = fmt::format("{} (quell:graph)", a.frame);
  request.text = then.graph;
  for (const auto& file : then.files) request.edits.push_back({Edit::Kind::set, file});
  if (!then.tap.empty()) request.edits.push_back({Edit::Kind::tap, then.tap});
  if (recorded) request.roles = recorded->roles();
  const auto graph = recorded ? commander.load(request, nullptr) : std::nullopt;
  if (!graph) return commander.report();
  const std::string name = then.tap.empty() ? then.output : then.tap;
  const auto output = std::ranges::find(graph->outputs, name, &GraphOutput::name);
  if (output == graph->outputs.end())
    throw Error(Exit::usage, fmt::format("{}: its graph has no output '{}', which it says to hold", a.frame, name));
  check_output(a, *recorded, then);
  check_state(then);

  std::vector<std::string> roles;
  for (const auto& input : graph->inputs) roles.push_back(input.name);
  const auto all = recorded->open(commander, roles, a.threads, &cancel);
  if (const int code = commander.report(); !all || code) return code ? code : int(Exit::input);
  Excerpt frames(*all, then.first, then.frame);
  if (frames.frames().empty() || frames.frames().back() != then.frame)
    throw Error(Exit::usage, fmt::format("{}: frame {} is not in its sequence", a.frame, then.frame));

  const FileLog log(frames);
  Provenance provenance(*graph, frames, log,
                        {command_line(), simd_in_use(), then.missing, then.state, commander.locations().graphs});
  const TemporaryFolder folder;
  const std::string path =
      a.output.empty() ? (folder.path() / ("again" + fs::path(a.frame).extension().string())).string() : a.output;
  WriteOptions options = then.options;
  options.metadata["quell:output"] = ImageFile(a.frame).texts()["quell:output"];
  LastFrame sink(*graph, std::size_t(output - graph->outputs.begin()), then.frame, path, std::move(options),
                 provenance);
  RunOptions run;
  run.threads = a.threads;
  run.load_state = then.state;
  run.cancel = &cancel;
  run_graph(*graph, frames, sink, run);

  auto changes = changes_of_program(then, plugin_versions(*graph, frames), *graph);
  const auto files = changes_of_files(then, provenance, sink.history);
  changes.insert(changes.end(), files.begin(), files.end());
  const std::string difference = picture_difference(a.frame, path);
  fmt::print("{}: {}\n", a.frame,
             difference.empty()
                 ? fmt::format("identical, bit for bit; made again from frames {}", frame_range_text(frames.frames()))
                 : "differs: " + difference);
  for (const auto& change : changes) fmt::print("  {}\n", change);
  if (!difference.empty() && changes.empty())
    fmt::print("  the graph, the plugins, the files and the instruction set are those that made it\n");
  return int(difference.empty() ? Exit::good : Exit::threshold);
}

}  // namespace

void add_rerun(CLI::App& app, int& exit) {
  auto* sub = app.add_subcommand("rerun", "Makes an image that Quell wrote again and tells whether it is the same.");
  auto a = std::make_shared<RerunArguments>();
  sub->add_option("frame", a->frame, "An image that Quell wrote: it says how it was made.")
      ->required()
      ->type_name("FRAME");
  sub->add_option("-o,--output", a->output, "Keeps the new image.")->type_name("FILE");
  sub->add_option("--root", a->root, "Folder that the sequence's files are in now.")->type_name("DIR");
  sub->add_option("--threads", a->threads, "Threads; 0: every core that affinity and quotas grant. Changes no bit.")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  a->plugins.add_to(*sub);
  sub->footer(
      "Exit codes: 0 identical, 1 it differs and what may be why, 2 it does not say how it was made, 3 files are "
      "missing.\n"
      "Examples:\n"
      "  quell rerun out/color.0007.exr\n"
      "  quell rerun color.0007.exr --root /shots/12 -o again.exr");
  sub->callback([a, &exit] { exit = rerun(*a); });
}

}  // namespace quell
