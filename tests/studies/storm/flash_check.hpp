// After a power cut: what the robot had been told since it last looked is in flash together, or not at all.
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
  /// What is wrong with what a robot has that was switched on again, in words. `in_write`: the power went while it
  /// wrote.
  [[nodiscard]] std::optional<std::string> compare(const Kept& restored, bool in_write) const;

  /// Told between the last two looks; a line of them, of which not all may be there.
  [[nodiscard]] std::optional<std::string> one_of_several() const;

 private:
  std::vector<Kept> states_;  ///< the last two; the later one was being written, or is there
};

/// A planted fault: a value that nobody told, written as the robot itself writes.
void plant_mixture(StormFlash& flash);
/// Another: a line of several that were told together is there alone.
void plant_half(StormFlash& flash, const std::string& line);

}  // namespace fencepost::test
