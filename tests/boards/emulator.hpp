// An emulator as a child process, with a socket for each serial line.
#pragma once

#include <sys/types.h>

#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "host/emulate/serve/peer.hpp"
#include "tests/boards/line.hpp"

namespace fencepost::test {

/// What has to be known of a board to talk to its image.
struct BoardUnderTest {
  std::string name;  ///< of its preset
  /// The emulator's command; `sockets`: paths to connect to, one a line.
  std::function<std::vector<std::string>(const std::vector<std::string>& sockets)> command;
  std::size_t lines = 1;
  std::size_t console = 0;  ///< its line
  int camera = -1;          ///< the camera's line; negative: frames go over the console
  int base = -1;            ///< the wheel base's line; negative: odometry goes over the console
  double camera_pace = 0;   ///< bytes a second of its line, where that is not 115200 baud
  /// Devices of the lines above; a camera's line without one has a Pixy2.
  std::function<std::unique_ptr<emulate::Peer>()> camera_device = {};
  std::function<std::unique_ptr<emulate::Peer>()> base_device = {};
  double frames_share = 0.9;  ///< of a scene's frames, as the camera can tell them
};

/// The folder with the images that this build has made.
std::string image_of(const std::string& board, const std::string& image = "fencepost");

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
  /// Ends it in good order, so that plugins can write what they know.
  void stop();

 private:
  void start(const std::vector<std::string>& command);

  std::string folder_;
  std::deque<Line> lines_;
  pid_t child_ = -1;
};

}  // namespace fencepost::test
