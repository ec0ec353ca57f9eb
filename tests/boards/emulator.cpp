#include "tests/boards/emulator.hpp"

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

constexpr std::chrono::milliseconds kPatience{10'000};
constexpr std::chrono::microseconds kNap{500};

std::string make_folder() {
  std::string name = (std::filesystem::temp_directory_path() / "fencepost-board-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make " + name);
  return name;
}

}  // namespace

std::string image_of(const std::string& board, const std::string& image) {
  return FENCEPOST_IMAGES_DIR "/" + board + "/" + image;
}

Emulator::Emulator(const BoardUnderTest& board) : folder_(make_folder()) {
  std::vector<std::string> sockets;
  for (std::size_t i = 0; i < board.lines; ++i) {
    sockets.push_back(folder_ + "/line" + std::to_string(i));
    lines_.emplace_back(sockets.back());
  }
  start(board.command(sockets));
  for (SocketLine& line : lines_) {
    if (!line.accept(kPatience)) throw std::runtime_error("the emulator did not connect its lines");
  }
}

Emulator::~Emulator() {
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

void Emulator::stop() {
  if (child_ <= 0) return;
  ::kill(child_, SIGTERM);
  ::waitpid(child_, nullptr, 0);
  child_ = -1;
}

void Emulator::pump() {
  for (SocketLine& line : lines_) line.pump(seconds());
  std::this_thread::sleep_for(kNap);
}

double Emulator::seconds() const { return std::chrono::duration<double>(WallClock::now() - started_).count(); }

}  // namespace fencepost::test
