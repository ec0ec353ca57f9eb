#include "tests/boards/stepped.hpp"

#include <stdexcept>

namespace fencepost::test {
namespace {

constexpr double kAtOnce = 1e12;
constexpr std::chrono::milliseconds kPatience{200'000};  // by the wall, beside a build
// Where it may stand still: after so long it does, and as much of the machine's time has gone by.
constexpr std::chrono::milliseconds kStanding{100};

}  // namespace

SteppedEmulator::SteppedEmulator(const BoardUnderTest& board, std::size_t control)
    : Emulator(board), control_(control) {
  this->control().set_pace(kAtOnce);
}

void SteppedEmulator::tell(const std::string& text) {
  control().send(text);
  move_control();
}

std::string SteppedEmulator::answer(std::chrono::milliseconds patience) {
  const auto until = WallClock::now() + patience;
  heard_ += control().take();  // it may have answered during the command
  std::size_t end = heard_.find('\n');
  while (end == std::string::npos) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - WallClock::now());
    if (left.count() <= 0) return {};
    const bool more = static_cast<SocketLine&>(control()).await(left);
    move_control();
    const std::string heard = control().take();
    heard_ += heard;
    if (more && heard.empty() && !alive()) throw std::runtime_error("the emulator has ended");
    end = heard_.find('\n');
  }
  const std::string line = heard_.substr(0, end);
  heard_.erase(0, end + 1);
  return line;
}

void SteppedEmulator::set_time(const std::string& answer) {
  if (!answer.starts_with("at ")) throw std::runtime_error("the emulator says '" + answer + "'");
  seconds_ = 1e-6 * std::stod(answer.substr(3));
}

void SteppedEmulator::move_lines() {
  for (std::size_t n = 0; n < lines(); ++n) {
    if (n != control_) line(n).pump(seconds());
  }
}

// By the wall's clock: it is no line of the board's.
void SteppedEmulator::move_control() { control().pump(Emulator::seconds()); }

bool EmulatedQemu::bytes_wait() {
  std::size_t sum = 0;
  for (std::size_t n = 0; n < lines(); ++n) sum += line(n).unread();
  return sum > 0;
}

// Its core, with all that is behind it: QEMU waits until a full line takes the next byte.
bool EmulatedQemu::may_stand() {
  bool blocked = may_stop_;
  for (std::size_t n = 0; n < lines(); ++n) blocked = blocked || line(n).blocked();
  return blocked;
}

// Bytes that came meanwhile can be answered in the next step.
void EmulatedQemu::pump() {
  move_lines();
  if (!running_) tell(bytes_wait() ? "f" : "g");
  running_ = true;
  const bool may_stand = this->may_stand();
  const std::string said = answer(may_stand ? kStanding : kPatience);
  if (said.empty() && may_stand) {
    stand(std::chrono::duration<double>(kStanding).count());
  } else {
    set_time(said);
    running_ = false;
  }
  move_lines();
}

// It gets the command to end while its core is held, and ends as soon as that goes on.
void EmulatedQemu::stop() {
  end();
  if (!running_) tell("g");
  Emulator::stop();
}

}  // namespace fencepost::test
