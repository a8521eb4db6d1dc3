// Ctrl-C: the first asks a run to end after what it is doing, the second ends the program; neither leaves half a file.
#pragma once

#include <atomic>

namespace quell {

// Installs handlers for SIGINT and SIGTERM and gives the flag that they raise.
const std::atomic<bool>& watch_interrupts();
// The exit code of a run that ended so: 128 + the signal.
int interrupted_exit();

}  // namespace quell
