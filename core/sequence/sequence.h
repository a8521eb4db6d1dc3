// A sequence: which files, or which source node, give the frames of which roles. Parsed from a sequence file, or made
// from a profile for files that come as a renderer wrote them.
#pragma once

#include "core/json/json.h"
#include "core/report/diagnostics.h"
#include "core/report/error.h"
#include "core/sequence/conversion.h"
#include "core/sequence/file_sequence.h"
#include "core/sequence/frame_pattern.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace quell {

// Channels that can play a role, and what must be done to them.
struct ChannelChoice {
  std::vector<std::string> channels;
  bool layered = false;  // any one layer's name and a dot may stand before all of them
  Conversion conversion;
  TextPosition position;
};

enum class FileFormat { image, games202, cameras_json };

struct SequenceInput {
  std::string role;
  int type = 0;  // quell_type
  FramePattern file;
  FileFormat format = FileFormat::image;
  std::vector<ChannelChoice>
      choices;  // the first whose channels exist is taken; channels empty: those usual for the type
  TextPosition position;
  std::string where;  // in the document: "inputs.color"; "" when a profile made it
};

// A node without inputs that makes the frames.
struct SourceNode {
  std::string type;
  std::optional<Json> set;  // an object
  TextPosition position;    // of the type's name
};

// A source node whose output "color" is the reference, or one half of it.
struct ReferenceSource {
  std::string role;  // as those of references
  SourceNode node;
};

struct Sequence {
  std::string path;
  std::filesystem::path root;  // folder that its files' names are relative to
  std::string about;
  std::vector<std::int64_t> frames;
  std::set<std::int64_t> cuts;
  std::vector<SequenceInput> inputs;      // of files; empty when there is a source node
  std::vector<SequenceInput> references;  // role "reference", or "reference_a" and "reference_b"; type radiance
  std::optional<SourceNode> source;
  std::vector<ReferenceSource> reference_sources;  // in place of references

  const SequenceInput* find(std::string_view role) const;  // among inputs and references, or nullptr
  std::map<std::string, int> roles() const;                // of inputs and references
};

struct SequenceRequest {
  // A sequence file (.json); a pattern of one renderer's multi-channel images; or a folder of files that a profile
  // knows.
  std::string path;
  std::optional<std::string> frames;  // --frames: in place of the file's own
  std::optional<std::string>
      root;  // --root: the folder that the files' names are relative to, in place of the file's own
  std::filesystem::path profiles;        // folder of the profiles
  std::optional<std::string> text = {};  // of a sequence file, in place of what `path` holds
};

// Parses and checks the document and says which frames there are; opens no image, except to recognise a profile.
// Mistakes in documents and options go to the diagnostics, and nothing is returned then; missing and damaged files
// throw Error(Exit::input).
std::optional<Sequence> load_sequence(const SequenceRequest&, Diagnostics&);

// Files of some frames are missing.
class MissingFrames : public Error {
 public:
  // `others`: there are frames that have all of theirs.
  MissingFrames(const std::string& text, bool others) : Error(Exit::input, text), others_(others) {}
  bool others() const { return others_; }

 private:
  bool others_;
};

// Opens a sequence of files for the roles that a graph reads (empty: all inputs): finds their channels in the first
// frame and looks for every frame's files. The diagnostics must be those of load_sequence, for places point into its
// texts. Channels that are not there go to the diagnostics, and nothing is returned then; a missing frame throws
// MissingFrames that names it and its file, unless `missing` says what to do instead.
std::unique_ptr<FileSequence> open_sequence(const Sequence&, std::span<const std::string> roles, Missing missing,
                                            Diagnostics&);

}  // namespace quell
