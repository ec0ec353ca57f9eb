#include "tests/boards/emulator.hpp"

#include <sched.h>
#include <unistd.h>

#include <stdexcept>
#include <thread>

namespace fencepost::test {
namespace {

// Until an emulator has read its image, by the wall's clock. Beside a build that took more than ten seconds.
constexpr std::chrono::milliseconds kPatience{200'000};

constexpr std::chrono::milliseconds kLook{500};  // between two looks whether it still runs

constexpr std::chrono::microseconds kNap{500};

// This program, the emulator's core and its loop take turns, a thousand times and more a second. On one processor that
// is half the work that it is on two. Of several tests at once each takes another processor.
void stay_on_one_processor() {
  cpu_set_t allowed;
  if (::sched_getaffinity(0, sizeof allowed, &allowed) != 0) return;
  int turn = static_cast<int>(::getpid() % CPU_COUNT(&allowed));
  for (std::size_t i = 0; i < CPU_SETSIZE; ++i) {
    if (!CPU_ISSET(i, &allowed) || turn-- > 0) continue;
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(i, &one);
    ::sched_setaffinity(0, sizeof one, &one);
    return;
  }
}

}  // namespace

std::string image_of(const std::string& board, const std::string& image) {
  return FENCEPOST_IMAGES_DIR "/" + board + "/" + image;
}

Emulator::Emulator(const BoardUnderTest& board) {
  std::vector<std::string> sockets;
  for (std::size_t i = 0; i < board.lines; ++i) {
    sockets.push_back(folder_.file("line" + std::to_string(i)));
    lines_.emplace_back(sockets.back());
  }
  start(board.command(sockets));
  for (SocketLine& line : lines_) await(line);
}

void Emulator::await(SocketLine& line) {
  while (!line.accept(kLook)) {
    if (child_->ended()) throw std::runtime_error("the emulator has ended before it connected its lines");
    if (WallClock::now() - started_ > kPatience) throw std::runtime_error("the emulator did not connect its lines");
  }
}

void Emulator::start(const std::vector<std::string>& command) {
  stay_on_one_processor();
  try {
    child_.emplace(command[0], command);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(std::string(error.what()) + "; toolchain/setup firmware installs it");
  }
}

bool Emulator::alive() { return child_ && !child_->ended(); }

void Emulator::stop() {
  if (end()) child_->wait();
}

void Emulator::pump() {
  for (SocketLine& line : lines_) line.pump(seconds());
  std::this_thread::sleep_for(kNap);
}

double Emulator::seconds() const { return std::chrono::duration<double>(WallClock::now() - started_).count(); }

}  // namespace fencepost::test
