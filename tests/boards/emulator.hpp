// A machine that runs an image: an emulator as a child process with a socket for each serial line, or another.
#pragma once

#include <signal.h>

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/emulate/models/device_model.hpp"
#include "tests/boards/line.hpp"
#include "tests/folder.hpp"
#include "tests/process/child.hpp"

namespace fencepost::test {

/// Something that runs an image.
class Machine {
 public:
  virtual ~Machine() = default;
  virtual Line& line(std::size_t n) = 0;
  /// It has not ended by itself.
  virtual bool alive() = 0;
  /// A moment: half a millisecond or so by its clock. All lines move.
  virtual void pump() = 0;
  /// By its clock.
  [[nodiscard]] virtual double seconds() const = 0;
  /// Ends it in good order, so that plugins can write what they know.
  virtual void stop() {}
};

/// The facts of a board that a test needs to talk to its image.
struct BoardUnderTest {
  std::string name;  ///< of its preset
  /// The emulator's command; `sockets`: paths to connect to, one a line.
  std::function<std::vector<std::string>(const std::vector<std::string>& sockets)> command;
  /// The emulator, where it is not an Emulator.
  std::function<std::unique_ptr<Machine>(const BoardUnderTest&)> machine = {};
  bool may_stop = false;  ///< a debugger is there to stop it
  std::size_t lines = 1;
  std::size_t console = 0;  ///< its line
  int camera = -1;          ///< the camera's line; negative: frames go over the console
  int base = -1;            ///< the wheel base's line; negative: odometry goes over the console
  double camera_pace = 0;   ///< bytes a second of its line, where that is not 115200 baud
  /// Devices of the lines above; a camera's line without one has a Pixy2.
  std::function<std::unique_ptr<emulate::DeviceModel>()> camera_device = {};
  std::function<std::unique_ptr<emulate::DeviceModel>()> base_device = {};
  double frames_share = 0.9;                 ///< of a scene's frames, as the camera can tell them
  std::vector<std::string> configured = {};  ///< settings that are typed first, such as "camera cmucam4"
};

/// The folder with the images that this build has made.
std::string image_of(const std::string& board, const std::string& image = "fencepost");

class Emulator : public Machine {
 public:
  /// Starts it and waits until all lines are connected. Throws std::runtime_error with the reason.
  explicit Emulator(const BoardUnderTest& board);
  Emulator(const Emulator&) = delete;
  Emulator& operator=(const Emulator&) = delete;

  SocketLine& line(std::size_t n) override { return lines_[n]; }
  [[nodiscard]] std::size_t lines() const { return lines_.size(); }
  bool alive() override;
  void pump() override;
  [[nodiscard]] double seconds() const override;
  void stop() override;

 protected:
  /// Asks it to end.
  bool end() { return child_ && child_->signal(SIGTERM); }

 private:
  void start(const std::vector<std::string>& command);
  void await(SocketLine& line);

  Folder folder_;
  std::deque<SocketLine> lines_;
  WallClock::time_point started_ = WallClock::now();
  std::optional<Child> child_;
};

}  // namespace fencepost::test
