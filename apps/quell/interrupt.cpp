// Ctrl-C without half a file.
#include "apps/quell/interrupt.h"

#include "core/sequence/temporary_file.h"

#include <unistd.h>
#include <csignal>

namespace quell {

namespace {

std::atomic<bool> interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free);

volatile std::sig_atomic_t last_signal = SIGINT;

void on_signal(int signal) {
  last_signal = signal;
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

int interrupted_exit() { return 128 + last_signal; }

}  // namespace quell
