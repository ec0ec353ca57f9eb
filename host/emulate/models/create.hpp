// Speaks as an iRobot Create 1 or 2: start, modes, sensor queries and the sensor stream of the Open Interface.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "host/emulate/models/create_commands.hpp"
#include "host/emulate/models/not_emulated.hpp"

namespace fencepost::emulate {

class CreateDevice {
 public:
  /// `header_in_checksum`: whether the stream's checksum takes the header in, on which the manuals disagree.
  CreateDevice(CreateModel model, bool header_in_checksum) : model_(model), header_in_checksum_(header_in_checksum) {}

  /// Off, then on: nothing is said before Start; the counts are zero.
  std::string power_up();
  std::string feed(std::string_view bytes);
  /// 15 ms have passed: a frame of the stream, if there is one.
  std::string frame();

  /// The wheels have turned, in counts (Create 2).
  void roll(int left, int right);
  /// The robot has moved, in mm and degrees (Create 1), fractions kept until read.
  void move(double mm, double degrees);
  /// The speeds that a program of its own requests, as packets 39 to 42 report; whoever drives it overrides them.
  void request(int left, int right) {
    if (!driven_) speeds_ = {left, right};
  }
  /// Drives for that time at the commanded speeds; does nothing before the first drive command.
  void drive_on(double seconds);
  /// A wheel drops or a cliff is seen: out of mode safe the robot falls back to passive, and stops.
  void lift();
  /// Commanded speeds of its wheels, mm/s.
  struct Speeds {
    int left = 0;
    int right = 0;
    friend bool operator==(const Speeds&, const Speeds&) = default;
  };
  [[nodiscard]] Speeds speeds() const { return speeds_; }
  /// Somebody has driven it since it was switched on.
  [[nodiscard]] bool driven() const { return driven_; }
  [[nodiscard]] int mode() const { return mode_; }
  [[nodiscard]] bool streaming() const { return streaming_; }
  /// Opcodes and packets that it does not have, or does not obey.
  [[nodiscard]] const std::vector<std::string>& not_emulated() const { return not_emulated_.names(); }

 private:
  [[nodiscard]] double track() const;  ///< mm
  std::string obey();
  void act(int opcode);
  void set_mode(int mode);
  void obey_drive();
  /// A packet's bytes, or a group's.
  std::string value_of(int id);
  std::string packet(int id);
  [[nodiscard]] int word(int id);

  CreateModel model_;
  bool header_in_checksum_;
  std::string pending_;  ///< a command, not yet whole
  int mode_ = 0;         ///< of packet 35: off, passive, safe, full
  bool streaming_ = false;
  std::vector<int> stream_;
  std::size_t unsent_ = 0;  ///< of the last frame
  std::uint16_t left_ = 0;
  std::uint16_t right_ = 0;
  double mm_ = 0;
  double degrees_ = 0;
  Speeds speeds_;
  bool driven_ = false;
  double left_rest_ = 0;  ///< of a count
  double right_rest_ = 0;
  NotEmulated not_emulated_;
};

}  // namespace fencepost::emulate
