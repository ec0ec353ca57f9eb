#include "host/cli/interrupt.hpp"

#include <unistd.h>

#include <array>
#include <csignal>
#include <cstring>
#include <string_view>

#include "host/cli/exit_code.hpp"

namespace fencepost::host::cli {
namespace {

// Plain memory, because a signal handler may touch nothing else.
std::array<char, 4096> path_to_remove{};
volatile std::sig_atomic_t armed = 0;
volatile std::sig_atomic_t progress_shown = 0;

void take_progress_away() {
  constexpr std::string_view kErase = "\r\x1b[K";
  if (progress_shown != 0) static_cast<void>(!::write(STDERR_FILENO, kErase.data(), kErase.size()));
}

extern "C" void on_interrupt(int) {
  take_progress_away();
  if (armed != 0) ::unlink(path_to_remove.data());
  ::_exit(static_cast<int>(Exit::kInterrupted));
}

// Ends as if there had been no handler: the sender sees its own signal.
extern "C" void on_termination(int number) {
  take_progress_away();
  if (armed != 0) ::unlink(path_to_remove.data());
  std::signal(number, SIG_DFL);
  std::raise(number);
}

// One that is ignored (nohup) stays so.
void clean_up_at(int number) {
  struct sigaction before {};
  if (::sigaction(number, nullptr, &before) == 0 && before.sa_handler == SIG_IGN) return;
  std::signal(number, on_termination);
}

}  // namespace

void handle_interrupts() {
  std::signal(SIGINT, on_interrupt);
  clean_up_at(SIGTERM);
  clean_up_at(SIGHUP);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

void note_progress_line(bool shown) { progress_shown = shown ? 1 : 0; }

RemoveOnInterrupt::RemoveOnInterrupt(const std::string& path) {
  if (path.size() >= path_to_remove.size()) return;
  std::memcpy(path_to_remove.data(), path.c_str(), path.size() + 1);
  armed = 1;
}

RemoveOnInterrupt::~RemoveOnInterrupt() { armed = 0; }

}  // namespace fencepost::host::cli
