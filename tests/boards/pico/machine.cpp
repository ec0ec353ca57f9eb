#include "tests/boards/pico/machine.hpp"

namespace fencepost::test {
namespace {

constexpr double kLinePace = 11'520;            // bytes a second at 115200 baud, which the emulator keeps
constexpr std::chrono::seconds kPatience{200};  // by the wall, beside a build
constexpr const char* kMoment = "run 1000";     // us

}  // namespace

EmulatedPico::EmulatedPico(const BoardUnderTest& board) : SteppedEmulator(board, kControl) {
  line(kConsole).limit_pace(kLinePace);
  line(kCamera).limit_pace(kLinePace);
}

void EmulatedPico::pump() {
  move_lines();
  set_time(ask(kMoment));
  move_lines();  // the next moment can answer what came meanwhile
}

void EmulatedPico::command(const std::string& line) { tell(line + "\n"); }

std::string EmulatedPico::ask(const std::string& line) {
  command(line);
  return answer(kPatience);
}

}  // namespace fencepost::test
