// Speaks as a CMUcam1, 2, 3 (emulating the 2) or 4.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hal/base/units.hpp"
#include "host/emulate/models/not_emulated.hpp"

namespace fencepost::emulate {

enum class CmuCamModel : std::uint8_t { kOne, kTwo, kThree, kFour };

/// Something coloured in the image: pixels 0-based, ends inclusive, in the camera's grid of the mode in force.
struct ColouredSpot {
  int red = 0;
  int green = 0;
  int blue = 0;
  int x1 = 0;
  int y1 = 0;
  int x2 = 0;
  int y2 = 0;
  int pixels = 0;
};

/// Echoes nothing, folds case, takes LF for garbage. A CMUcam4 ignores all control characters but CR, backspace and
/// tab, so a host that seeks its baud rate can begin with zeros. One box covers all that matches: the camera knows no
/// second one.
/// Emulated traps: raw input takes a CR for a count. A CMUcam3 turns raw arguments 97..122 to upper case, ends its GV
/// without CR, and stays mute on swapped bounds.
class CmuCamDevice {
 public:
  explicit CmuCamDevice(CmuCamModel model) : model_(model) {}

  /// A CMUcam3 and a CMUcam4 start for two seconds, in which they hear nothing; the others at once.
  static constexpr base::Duration kStart = base::milliseconds(2'000);

  /// Switched on, with all settings at their defaults.
  std::string power_up();
  /// It is starting: after kStart, `finish_start` answers what it says then.
  [[nodiscard]] bool starting() const { return starting_; }
  std::string finish_start();
  std::string feed(std::string_view bytes);
  /// One image has been taken: the packet, if any is due.
  std::string frame(std::span<const ColouredSpot> spots);
  [[nodiscard]] bool tracking() const { return tracking_; }
  /// Baud rate that BM has set since the start; 0: as at the start.
  [[nodiscard]] std::uint32_t baud() const { return baud_; }
  /// Commands that it does not know, and those that it accepts though they change nothing here.
  [[nodiscard]] const std::vector<std::string>& not_emulated() const { return not_emulated_.names(); }

 private:
  struct Command {
    std::string name;
    std::vector<int> arguments;
    bool bad = false;
  };

  std::string feed_byte(char byte);
  bool edit(char byte);
  std::string feed_raw(char byte);
  [[nodiscard]] Command parsed(std::string_view line) const;
  std::string obey(const Command& command);
  std::string act(const Command& command);
  [[nodiscard]] std::string answer(bool good, std::string_view data = {}) const;
  [[nodiscard]] std::string banner() const;
  static std::string told(std::span<const int> numbers);
  [[nodiscard]] std::string packet(std::span<const ColouredSpot> spots) const;
  [[nodiscard]] std::string greeting() const;
  void reset();

  CmuCamModel model_;
  std::string line_;
  std::string raw_;
  int bounds_[6] = {};
  int window_[4] = {0, 0, 159, 119};  ///< of SW on a CMUcam4, as set: it hides nothing
  int mode_ = 0;                      ///< of RM
  std::uint32_t baud_ = 0;
  bool polled_ = false;
  bool tracking_ = false;
  bool reports_middle_ = true;
  bool starting_ = false;
  NotEmulated not_emulated_;
};

}  // namespace fencepost::emulate
