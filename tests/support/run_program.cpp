// Runs a program; its output goes to files in memory, so that no pipe can fill up.
#include "tests/support/run_program.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <thread>

namespace quell::test {

namespace {

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

std::string content(int file) {
  std::string text;
  char block[1 << 14];
  for (ssize_t n; (n = pread(file, block, sizeof block, off_t(text.size()))) > 0;) text.append(block, std::size_t(n));
  return text;
}

// In the child; gives back only when something failed.
void become(const std::vector<std::string>& command, const ProgramOptions& options, int out, int err) {
  if (!options.folder.empty() && chdir(options.folder.c_str()) != 0) return;
  const int in = open("/dev/null", O_RDONLY);
  if (!options.out.empty()) out = open(options.out.c_str(), O_WRONLY);
  if (dup2(in, 0) < 0 || dup2(out, 1) < 0 || dup2(err, 2) < 0) return;
  for (const auto& [name, value] : options.environment) setenv(name.c_str(), value.c_str(), 1);
  if (options.file_bytes >= 0) {
    const rlimit limit{rlim_t(options.file_bytes), rlim_t(options.file_bytes)};
    if (setrlimit(RLIMIT_FSIZE, &limit) != 0) return;
  }
  std::vector<char*> arguments;
  for (const auto& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  execv(arguments[0], arguments.data());
}

}  // namespace

Program::Program(std::vector<std::string> command, ProgramOptions options)
    : out_(memfd_create("stdout", MFD_CLOEXEC)),
      err_(memfd_create("stderr", MFD_CLOEXEC)),
      end_(now() + options.seconds) {
  id_ = fork();
  if (out_ < 0 || err_ < 0 || id_ < 0) throw std::runtime_error("cannot start " + command[0]);
  if (id_ > 0) return;
  become(command, options, out_, err_);
  _exit(127);
}

Program::~Program() {
  if (running()) send(SIGKILL), waitpid(id_, &status_, 0);
  close(out_);
  close(err_);
}

bool Program::running() {
  if (!ended_) ended_ = waitpid(id_, &status_, WNOHANG) == id_;
  return !ended_;
}

std::string Program::out() const { return content(out_); }
std::string Program::err() const { return content(err_); }
bool Program::late() const { return now() > end_; }
void Program::send(int signal) const { kill(id_, signal); }

bool Program::wait_until(const std::function<bool()>& holds) {
  while (running() && !late()) {
    if (holds()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

ProgramResult Program::finish() {
  wait_until([] { return false; });
  ProgramResult result;
  result.late = !ended_;
  if (!ended_) send(SIGKILL), waitpid(id_, &status_, 0), ended_ = true;
  if (WIFEXITED(status_)) result.exit = WEXITSTATUS(status_);
  if (WIFSIGNALED(status_)) result.signal = WTERMSIG(status_);
  result.out = out(), result.err = err();
  return result;
}

ProgramResult run_program(std::vector<std::string> command, ProgramOptions options) {
  return Program(std::move(command), std::move(options)).finish();
}

}  // namespace quell::test
