// Ctrl-C without half a file.
#include "apps/quell/interrupt.h"

#include "core/sequence/temporary_file.h"

#include <unistd.h>
#include <csignal>

namespace quell {

namespace {

std::atomic<bool> interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free);

void on_signal(int signal) {
  if (interrupted.exchange(true)) {
    remove_temporaries();
    _exit(128 + signal);
  }
}

}  // namespace

const std::atomic<bool>& watch_interrupts() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  return interrupted;
}

}  // namespace quell
