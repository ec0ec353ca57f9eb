// The part of a console that is the same for all ports.
#include <algorithm>
#include <array>

#include "host/live/console_port.hpp"

namespace fencepost::host {

using base::Error;

void ConsolePort::watch(linux::WaitSet& set, bool output_waits) const {
  set.add_readable(descriptor());
  if (output_waits) set.add_writable(descriptor());
}

base::Result<std::size_t> PatientConsole::write(std::span<const std::uint8_t> out) {
  if (out.empty()) return std::size_t{0};
  if (discarding_) return resume(out);
  const std::size_t taken = send(out);
  if (taken > 0) {
    stuck_since_.reset();
    return taken;
  }
  if (!stuck_since_) stuck_since_ = now_;
  const bool patient = !may_lose_ || now_ - *stuck_since_ < kPatience;
  if (port_.connected() && patient) return Error::kFull;
  discarding_ = true;
  cut_begun_ = line_begun_;
  return discard(out);
}

std::size_t PatientConsole::send(std::span<const std::uint8_t> out) {
  const base::Result<std::size_t> taken = port_.write(out);
  if (!taken || *taken == 0) return 0;
  line_begun_ = out[*taken - 1] != '\n';
  return *taken;
}

std::size_t PatientConsole::discard(std::span<const std::uint8_t> out) {
  cut_begun_ = out.back() != '\n';
  lost_ += out.size();
  return out.size();
}

// From the next line on, if the port takes anything again; a line that was cut is ended first.
std::size_t PatientConsole::resume(std::span<const std::uint8_t> out) {
  std::size_t begin = 0;
  if (cut_begun_) {
    while (begin < out.size() && out[begin] != '\n') ++begin;
    begin = std::min(begin + 1, out.size());
  }
  if (begin == out.size() || !port_.connected()) return discard(out);
  constexpr std::array<std::uint8_t, 2> kLineEnd = {'\r', '\n'};
  if (line_begun_ && send(kLineEnd) != kLineEnd.size()) return discard(out);
  const std::size_t taken = send(out.subspan(begin));
  if (taken == 0) return discard(out);
  lost_ += begin;
  discarding_ = false;
  stuck_since_.reset();
  return begin + taken;
}

void PatientConsole::tend(base::Time now) {
  now_ = now;
  port_.tend(now);
}

}  // namespace fencepost::host
