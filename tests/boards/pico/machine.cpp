#include "tests/boards/pico/machine.hpp"

#include <stdexcept>

namespace fencepost::test {
namespace {

constexpr double kLinePace = 11'520;  // bytes a second at 115200 baud, which the emulator keeps
constexpr double kAtOnce = 1e12;
constexpr std::chrono::seconds kPatience{1};
constexpr const char* kMoment = "run 1000";  // us

}  // namespace

EmulatedPico::EmulatedPico(const BoardUnderTest& board) : Emulator(board) {
  line(kConsole).limit_pace(kLinePace);
  line(kCamera).limit_pace(kLinePace);
  line(kControl).set_pace(kAtOnce);
}

void EmulatedPico::pump() {
  move_lines();
  const std::string answer = ask(kMoment);
  if (!answer.starts_with("at ")) throw std::runtime_error("the emulator says " + answer);
  seconds_ = 1e-6 * std::stod(answer.substr(3));
  move_lines();  // what was said meanwhile can be answered in the next moment
}

void EmulatedPico::command(const std::string& line) {
  this->line(kControl).send(line + "\n");
  move_control();
}

std::string EmulatedPico::ask(const std::string& line) {
  command(line);
  SocketLine& control = this->line(kControl);
  std::string heard = control.take();
  while (!heard.ends_with('\n')) {
    const bool more = control.await(kPatience);
    move_control();
    heard += control.take();
    if (more && heard.empty() && !alive()) throw std::runtime_error("the emulator has ended");
  }
  heard.pop_back();
  return heard;
}

void EmulatedPico::move_lines() {
  for (std::size_t n = 0; n < kControl; ++n) line(n).pump(seconds_);
}

// By the wall's clock: it is no line of the board's.
void EmulatedPico::move_control() { line(kControl).pump(Emulator::seconds()); }

}  // namespace fencepost::test
