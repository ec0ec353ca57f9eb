#include "host/cli/stop_signals.hpp"

#include <array>
#include <cerrno>

namespace fencepost::host::cli {
namespace {

constexpr std::array<int, 3> kSignals = {SIGINT, SIGTERM, SIGHUP};

volatile std::sig_atomic_t caught_signal = 0;
// Set before the handler is, and cleared after it.
linux::SignalFlag* raised_flag = nullptr;
void (*undo_at_second)() = nullptr;
std::array<struct sigaction, kSignals.size()> before{};

// A terminal that closes sends SIGHUP, and its shell once more: that asks for no haste.
extern "C" void note_signal(int number) {
  const int error = errno;
  if (caught_signal == 0) {
    caught_signal = number;
    if (raised_flag != nullptr) raised_flag->raise();
  } else if (number != SIGHUP) {
    if (undo_at_second != nullptr) undo_at_second();
    std::signal(number, SIG_DFL);
    std::raise(number);
  }
  errno = error;
}

}  // namespace

StopSignals::StopSignals() {
  caught_signal = 0;
  if (auto flag = linux::SignalFlag::open()) flag_.emplace(std::move(*flag));
  raised_flag = flag_ ? &*flag_ : nullptr;
  struct sigaction action {};
  action.sa_handler = note_signal;  // no SA_RESTART: a blocking call returns
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    ::sigaction(kSignals[i], nullptr, &before[i]);
    if (before[i].sa_handler != SIG_IGN) ::sigaction(kSignals[i], &action, nullptr);
  }
}

StopSignals::~StopSignals() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) ::sigaction(kSignals[i], &before[i], nullptr);
  raised_flag = nullptr;
  undo_at_second = nullptr;
}

const volatile std::sig_atomic_t& StopSignals::caught() { return caught_signal; }

void StopSignals::on_second(void (*undo)()) { undo_at_second = undo; }

}  // namespace fencepost::host::cli
