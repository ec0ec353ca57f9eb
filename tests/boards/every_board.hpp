// The tests of every board. A board's own tests give its facts, by INSTANTIATE_TEST_SUITE_P, with its name.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <ostream>
#include <string>

#include "tests/boards/bench.hpp"
#include "tests/boards/counting.hpp"

namespace fencepost::test {

struct EveryBoardFacts {
  std::function<BoardUnderTest()> board;
  std::string name;     ///< as it says it
  std::string profile;  ///< the one that its image was built with
  std::string reset;    ///< why it started, as it knows when the emulator is switched on
  double rate = 20;     ///< frames a second that it keeps up with, with three objects
  /// m, how far off an object may be in a corridor of six: more where the table is smaller than that.
  double corridor_placed = 0.08;
  double corrected_seconds = 20;  ///< of a minute's scene with a corrected pose
  double corrected_rate = 20;     ///< frames a second that it keeps up with then

  /// Expects that a table full of objects costs what is committed (tests/boards/counting.hpp).
  std::function<void(PoseCorrected)> count;

  friend std::ostream& operator<<(std::ostream& out, const EveryBoardFacts& facts) { return out << facts.name; }
};

class EveryBoard : public ::testing::TestWithParam<EveryBoardFacts> {
 protected:
  [[nodiscard]] static BoardUnderTest board() { return GetParam().board(); }
};
/// The name behind a test's: its profile.
inline std::string profile_of(const ::testing::TestParamInfo<EveryBoardFacts>& info) { return info.param.profile; }

}  // namespace fencepost::test
