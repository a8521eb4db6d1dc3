// Runs a program as a user does, with a time limit, and gives what came of it.
#pragma once

#include <sys/types.h>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace quell::test {

struct ProgramResult {
  int exit = -1;      // exit code; -1 when a signal ended it
  int signal = 0;     // that ended it
  bool late = false;  // it ran past its limit and was killed
  std::string out, err;
};

struct ProgramOptions {
  std::string folder;                              // to run in; empty: this one
  std::map<std::string, std::string> environment;  // on top of this process's
  std::string out;       // a file for stdout, such as /dev/full, in place of what the result gives
  long file_bytes = -1;  // limit on the size of each file that it writes; -1: none
  double seconds = 120;
};

// A program that runs beside the test.
class Program {
 public:
  // The program and its arguments; standard input is empty.
  explicit Program(std::vector<std::string> command, ProgramOptions = {});
  ~Program();  // kills it if it still runs
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  pid_t id() const { return id_; }
  bool running();
  // A line of its /proc status, as a number to the base; 0 when it has gone.
  std::uint64_t status(const std::string& key, int base = 10) const;
  std::string out() const;  // so far
  std::string err() const;
  // Waits until this holds; false when the program ended, or its time was over, before it did.
  bool wait_until(const std::function<bool()>& holds);
  void send(int signal) const;
  // Waits for its end.
  ProgramResult finish();

 private:
  bool late() const;

  pid_t id_ = -1;
  int out_ = -1, err_ = -1, status_ = 0;
  bool ended_ = false;
  double end_ = 0;
};

ProgramResult run_program(std::vector<std::string> command, ProgramOptions = {});

}  // namespace quell::test
