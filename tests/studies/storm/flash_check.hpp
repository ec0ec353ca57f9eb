// After a power cut in the middle of a write: each thing that the robot had been told is as it was before or after.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/studies/storm/robot.hpp"

namespace fencepost::test {

class FlashCheck {
 public:
  /// In a quiet moment: what is in flash now, or was when this was called last.
  void remember(const Kept& kept);
  /// While a cut is due: what the robot has been told meanwhile.
  void note(const Kept& kept);
  /// What is wrong with what a robot has that was switched on again, in words.
  [[nodiscard]] std::optional<std::string> compare(const Kept& restored) const;
  void forget() { noted_.clear(), remembered_.clear(); }

 private:
  std::vector<Kept> remembered_;  ///< the last two
  std::vector<Kept> noted_;
};

/// A planted fault: a value that nobody told, written as the robot itself writes.
void plant_mixture(StormFlash& flash);

}  // namespace fencepost::test
