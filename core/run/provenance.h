// How pictures came to be, to be kept with them: enough to make them again and to tell what has changed since.
#pragma once

#include "core/graph/graph.h"
#include "core/run/file_log.h"
#include "core/sequence/image_writer.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace quell {

// Attributes of an image file, by name.
using Texts = std::map<std::string, std::string>;

// "atrous 1.0, gaussian 1.0": the node types of a graph and of what makes its frames, with the plugins' versions.
std::string plugin_versions(const Graph&, const FrameSource&);

class Provenance {
 public:
  // What a run knows of itself besides its graph and its frames.
  struct Run {
    std::vector<std::string> command;
    std::string simd;
    std::string missing = "error";     // --missing
    std::filesystem::path load_state;  // empty: none
    std::filesystem::path graphs;      // folder of installed graphs
  };
  // Hashes the files that the graph's nodes name and the saved state. `source` has what the graph reads, and the log,
  // which outlives this, tells of its files.
  Provenance(const Graph&, const FrameSource& source, const FileLog& log, const Run&);

  // Frames in the order in which they run: history_begins before each that has no past, texts once for each.
  void history_begins(std::int64_t frame);
  // Attributes of what is written of this frame:
  //   quell:version, quell:simd     the program, and the instruction set of its kernels
  //   quell:plugins                 node types and their plugins' versions
  //   quell:command, quell:directory  as a shell takes it, and where it was given
  //   quell:graph, quell:fingerprint  the graph with its edits, as a graph file, and its identity
  //   quell:files                   files that the graph's nodes name, as values of --set (where there are some)
  //   quell:sequence                a sequence file, or several of them joined (core/lab/joined_source.h)
  //   quell:missing                 what was done about missing frames (where that was said)
  //   quell:frames                  "0-7": the frames of this one's history, where the graph looks back, and itself
  //   quell:inputs                  JSON: the hash of each file that this frame was made from
  //   quell:history                 for each earlier frame of the history, a hash of its quell:inputs
  //   quell:state                   JSON: the saved state that the history goes on from, and its hash (where it does)
  Texts texts(std::int64_t frame);

  // The same of the whole run, as JSON.
  std::string report() const;
  // Files of a frame, with their hashes.
  Texts files(std::int64_t frame) const;

 private:
  const FileLog* log_;
  std::vector<std::string> roles_;  // that the graph reads
  Texts texts_;                     // those that are the same for all frames
  Texts named_;                     // files that nodes name, with their hashes
  bool looks_back_;
  std::int64_t first_ = 0;
  std::string history_;  // hashes of the frames from first_ on
};

// quell:output, what `quell rerun` must know to write an output again: its name and type, whether it is a tap or a
// preview, and how it is stored.
std::string output_text(const Graph&, const GraphOutput&, const WriteOptions&);

// Hash of a frame's files, as quell:history has it.
std::string short_hash(const std::string& inputs);

}  // namespace quell
