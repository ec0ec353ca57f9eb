// After a power cut: all that was configured since the robot last looked is in flash together, or nothing of it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/studies/storm/robot.hpp"

namespace fencepost::test {

class FlashCheck {
 public:
  /// It was switched on: this is in flash.
  void begin(const Kept& kept) { states_ = {kept}; }
  /// The robot has looked for changes, and written what has changed.
  void note(const Kept& kept);
  /// The fault, in words, in the configuration of a robot that was switched on again. `in_write`: the power went while
  /// it wrote.
  [[nodiscard]] std::optional<std::string> compare(const Kept& restored, bool in_write) const;

  /// One line of several that were configured between the last two looks: it may not be there alone.
  [[nodiscard]] std::optional<std::string> one_of_several() const;

 private:
  std::vector<Kept> states_;  ///< the last two; the later one was being written, or is there
};

/// A planted fault: a value that nobody configured, written as the robot itself writes.
void plant_mixture(StormFlash& flash);
/// Another: a line of several that were configured together is there alone.
void plant_half(StormFlash& flash, const std::string& line);

}  // namespace fencepost::test
