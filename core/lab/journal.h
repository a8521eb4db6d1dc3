// What a study has finished, on disk: a run that was ended in any way goes on from here.
#pragma once

#include "core/lab/results.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace quell {

// One variant on one sequence with one seed.
struct JournalEntry {
  std::string variant;
  std::string key;                    // of all that decides its numbers: an entry of another key is as good as none
  std::vector<FrameNumbers> numbers;  // of the frames so far
  std::vector<double> own_seconds;    // that threads spent on its nodes, by frame; as if it had run alone
  double judged_seconds = 0;          // and on those of its metrics
  double shared_seconds = 0;          // its part of what was really spent: what variants share counts in equal parts
};

// A merged run that is not at its end.
struct JournalPart {
  std::vector<JournalEntry> entries;  // of the variants that run together
  std::string files;                  // FileLog::text() of the frames so far
  std::string state;                  // file of the history behind the last frame of all entries, in the same folder
};

// Of one sequence with one seed; every file appears whole or not at all.
class Journal {
 public:
  explicit Journal(std::filesystem::path folder) : folder_(std::move(folder)) {}

  // What is finished of a variant under this key.
  std::optional<JournalEntry> finished(const std::string& variant, const std::string& key) const;
  std::optional<JournalPart> part() const;

  // Where the state behind frame number `next` of the sequence is to be saved, before the part is.
  std::filesystem::path state_file(std::size_t next) const;
  // In place of the part before; the states that it does not name go.
  void save(const JournalPart&) const;
  // The part is complete: its entries are finished, and it goes.
  void finish(const JournalPart&) const;

 private:
  std::filesystem::path entry_file(const std::string& variant) const;
  std::filesystem::path part_file() const;

  std::filesystem::path folder_;
};

}  // namespace quell
