#include "tests/boards/emulator.hpp"

#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <stdexcept>
#include <thread>

extern char** environ;

namespace fencepost::test {
namespace {

constexpr std::chrono::milliseconds kPatience{30'000};
constexpr std::chrono::microseconds kNap{500};
constexpr double kLinePace = 11'520;  // bytes a second at 115200 baud

std::string make_folder() {
  std::string name = (std::filesystem::temp_directory_path() / "fencepost-board-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make " + name);
  return name;
}

}  // namespace

std::string image_of(const std::string& board) { return FENCEPOST_IMAGES_DIR "/" + board + "/fencepost"; }

Emulator::Emulator(const BoardUnderTest& board) : folder_(make_folder()), control_(board.control) {
  if (control_ >= 0) BenchClock::emulated = BenchClock::duration{0};  // before the lines look at it
  std::vector<std::string> sockets;
  for (std::size_t i = 0; i < board.lines; ++i) {
    sockets.push_back(folder_ + "/line" + std::to_string(i));
    lines_.emplace_back(sockets.back());
  }
  start(board.command(sockets));
  for (Line& line : lines_) {
    if (!line.accept(kPatience)) throw std::runtime_error("the emulator did not connect its lines");
    if (control_ >= 0) line.limit_pace(kLinePace);
  }
  if (control_ < 0) return;
  lines_[static_cast<std::size_t>(control_)].limit_pace(1e12);
}

Emulator::~Emulator() {
  BenchClock::emulated.reset();
  if (child_ > 0) {
    ::kill(child_, SIGKILL);
    ::waitpid(child_, nullptr, 0);
  }
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

void Emulator::start(const std::vector<std::string>& command) {
  std::vector<char*> words;
  for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  if (::posix_spawnp(&child_, words[0], nullptr, nullptr, words.data(), environ) != 0) {
    child_ = -1;
    throw std::runtime_error("cannot start " + command[0] + "; toolchain/setup firmware installs it");
  }
}

bool Emulator::alive() {
  if (child_ <= 0) return false;
  if (::waitpid(child_, nullptr, WNOHANG) == 0) return true;
  child_ = -1;
  return false;
}

void Emulator::wait() {
  if (control_ < 0) return std::this_thread::sleep_for(kNap);
  const std::string answer = ask("run 1000");
  if (!answer.starts_with("at ")) throw std::runtime_error("the emulator says " + answer);
  BenchClock::emulated = std::chrono::microseconds(std::stoll(answer.substr(3)));
}

std::string Emulator::ask(const std::string& line) {
  command(line);
  Line& control = lines_[static_cast<std::size_t>(control_)];
  std::string heard;
  for (;;) {
    control.pump();
    heard += control.take();
    if (!heard.empty() && heard.back() == '\n') break;
    pollfd there{control.socket(), POLLIN, 0};
    if (::poll(&there, 1, 1000) < 1 && !alive()) throw std::runtime_error("the emulator has ended");
    if ((there.revents & POLLHUP) != 0) throw std::runtime_error("the emulator has ended");
  }
  heard.pop_back();
  return heard;
}

void Emulator::stop() {
  if (child_ <= 0) return;
  ::kill(child_, SIGTERM);
  ::waitpid(child_, nullptr, 0);
  child_ = -1;
}

void Emulator::pump() {
  for (Line& line : lines_) line.pump();
}

}  // namespace fencepost::test
