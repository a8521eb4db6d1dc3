// Pictures that are compared, and what they are judged by, opened from what the command line says of them.
#pragma once

#include "apps/quell/command.h"

#include "core/lab/joined_source.h"

#include <atomic>
#include <set>
#include <string>

namespace quell {

// One side of a comparison: "out/color.####.exr", "NAME=PATTERN", a sequence file, or a built-in sequence.
struct Pictures {
  std::string name;  // what tables call it; the text itself when it names none
  std::string text;
};
// Throws Error(Exit::usage) when the name is not made of letters, digits and _-+. or nothing follows it.
Pictures parse_pictures(const std::string& text);

struct OpenPictures {
  const std::string& frames;  // --frames; "": all
  const std::string& root;    // of sequence files; "": their own
  // Folder where references are kept that a source node makes; "": none are.
  const std::string& references;
  int threads;
  const std::atomic<bool>* cancel;
  std::set<std::string>& read;  // gets the plain paths of all files that are read
};

// Absolute and without detours, so that two names of one file are one.
std::string plain_path(const std::string& path);

// The colour of the pictures, as role `role`. Like those below it adds nothing when there are mistakes, which are with
// the diagnostics then, and throws Error(Exit::input) for files that are not there.
void open_pictures(Commander&, const std::string& text, const std::string& label, const std::string& role,
                   const OpenPictures&, std::vector<JoinedSource::Part>& parts);

// A sequence gives its own reference, in halves if it has them, or its colour when it has none; pictures their colour.
// What a node makes of it is kept.
void open_reference(Commander&, const std::string& text, const std::string& label, const OpenPictures&,
                    std::vector<JoinedSource::Part>& parts);

// Those of `roles` that a sequence gives, under their own names: motion, ids and so on.
void open_features(Commander&, const std::string& text, const std::string& label, const std::set<std::string>& roles,
                   const OpenPictures&, std::vector<JoinedSource::Part>& parts);

// Whether the text means a sequence rather than pictures.
bool is_sequence(const std::string& text);

}  // namespace quell
