#include "host/cli/interrupt.hpp"

#include <unistd.h>

#include <array>
#include <csignal>
#include <cstring>

#include "host/cli/exit_code.hpp"

namespace fencepost::host::cli {
namespace {

// Plain memory, because a signal handler may touch nothing else.
std::array<char, 4096> path_to_remove{};
volatile std::sig_atomic_t armed = 0;

extern "C" void on_interrupt(int) {
  if (armed != 0) ::unlink(path_to_remove.data());
  ::_exit(static_cast<int>(Exit::kInterrupted));
}

}  // namespace

void handle_interrupts() {
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

RemoveOnInterrupt::RemoveOnInterrupt(const std::string& path) {
  if (path.size() >= path_to_remove.size()) return;
  std::memcpy(path_to_remove.data(), path.c_str(), path.size() + 1);
  armed = 1;
}

RemoveOnInterrupt::~RemoveOnInterrupt() { armed = 0; }

}  // namespace fencepost::host::cli
