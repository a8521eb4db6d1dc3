// Runs a program; its output goes to files in memory, so that no pipe can fill up.
#include "tests/support/run_program.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
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

// Strings as C wants them.
std::vector<char*> pointers(const std::vector<std::string>& strings) {
  std::vector<char*> list;
  for (const auto& s : strings) list.push_back(const_cast<char*>(s.c_str()));
  list.push_back(nullptr);
  return list;
}

std::vector<std::string> environment_with(const std::map<std::string, std::string>& more) {
  std::vector<std::string> all;
  for (char** entry = environ; *entry; ++entry) {
    const std::string text = *entry;
    if (!more.contains(text.substr(0, text.find('=')))) all.push_back(text);
  }
  for (const auto& [name, value] : more) all.push_back(name + "=" + value);
  return all;
}

// The limit on files' sizes that children inherit, for as long as this lives. This process writes none meanwhile.
class FileLimit {
 public:
  explicit FileLimit(long bytes) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes < 0 ? before_.rlim_cur : rlim_t(bytes), before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileLimit() { setrlimit(RLIMIT_FSIZE, &before_); }
  FileLimit(const FileLimit&) = delete;
  FileLimit& operator=(const FileLimit&) = delete;

 private:
  rlimit before_{};
};

// Without fork: libraries that this process has loaded may hang on to threads in its handlers.
pid_t spawn(const std::vector<std::string>& command, const ProgramOptions& options, int out, int err) {
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  if (!options.folder.empty()) posix_spawn_file_actions_addchdir_np(&files, options.folder.c_str());
  posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
  if (options.out.empty())
    posix_spawn_file_actions_adddup2(&files, out, 1);
  else
    posix_spawn_file_actions_addopen(&files, 1, options.out.c_str(), O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&files, err, 2);
  const auto environment = environment_with(options.environment);
  const FileLimit limit(options.file_bytes);
  pid_t id = -1;
  const int failed =
      posix_spawn(&id, command[0].c_str(), &files, nullptr, pointers(command).data(), pointers(environment).data());
  posix_spawn_file_actions_destroy(&files);
  if (failed) throw std::runtime_error("cannot start " + command[0] + ": " + std::strerror(failed));
  return id;
}

}  // namespace

Program::Program(std::vector<std::string> command, ProgramOptions options)
    : out_(memfd_create("stdout", MFD_CLOEXEC)),
      err_(memfd_create("stderr", MFD_CLOEXEC)),
      end_(now() + options.seconds) {
  if (out_ < 0 || err_ < 0) throw std::runtime_error("no files in memory");
  id_ = spawn(command, options, out_, err_);
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

std::uint64_t Program::status(const std::string& key, int base) const {
  std::ifstream in("/proc/" + std::to_string(id_) + "/status");
  for (std::string line; std::getline(in, line);)
    if (line.starts_with(key + ":")) return std::stoull(line.substr(key.size() + 1), nullptr, base);
  return 0;
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
