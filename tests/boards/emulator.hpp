// An emulator as a child process, with a socket for each serial line.
#pragma once

#include <sys/types.h>

#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "tests/boards/line.hpp"

namespace fencepost::test {

/// What has to be known of a board to talk to its image.
struct BoardUnderTest {
  std::string name;  ///< of its preset
  /// The emulator's command; `sockets`: paths to connect to, one a line.
  std::function<std::vector<std::string>(const std::vector<std::string>& sockets)> command;
  std::size_t lines = 1;
  std::size_t console = 0;  ///< its line
  int camera = -1;          ///< the Pixy2's line; negative: frames go over the console
  /// The line on which an emulator with a time of its own is told to go on; negative: it lives in real time.
  /// `run MICROSECONDS` is answered by `at MICROSECONDS` when all has been said that was to say until then.
  int control = -1;
};

/// The folder with the images that this build has made.
std::string image_of(const std::string& board);

class Emulator {
 public:
  /// Starts it and waits until all lines are connected. Throws std::runtime_error with the reason.
  explicit Emulator(const BoardUnderTest& board);
  ~Emulator();
  Emulator(const Emulator&) = delete;
  Emulator& operator=(const Emulator&) = delete;

  [[nodiscard]] Line& line(std::size_t n) { return lines_[n]; }
  /// It has not ended by itself.
  [[nodiscard]] bool alive();
  void pump();
  /// A while passes: half a millisecond of the wall's time, or one of the emulator's own. Throws if it has ended.
  void wait();
  /// A word to an emulator that has a control line.
  void command(const std::string& line) { lines_[static_cast<std::size_t>(control_)].send(line + "\n"); }
  /// What it answers.
  std::string ask(const std::string& line);
  /// Ends it in good order, so that plugins can write what they know.
  void stop();

 private:
  void start(const std::vector<std::string>& command);

  std::string folder_;
  int control_;
  std::deque<Line> lines_;
  pid_t child_ = -1;
};

}  // namespace fencepost::test
