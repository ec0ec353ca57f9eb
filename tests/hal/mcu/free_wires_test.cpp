#include "hal/mcu/free_wires.hpp"

#include <gtest/gtest.h>

#include <string>

namespace fencepost::mcu {
namespace {

/// A device in the middle of a byte: it holds the data wire until the clock has come so often.
struct Bus {
  int holds = 0;
  bool clock_low = false;
  bool data_low = false;
  int clocks = 0;
  std::string said;  ///< S: the data wire rises while the clock is high, a stop; c: a clock

  void pull_clock(bool low) {
    if (clock_low && !low) {
      ++clocks;
      said += 'c';
    }
    clock_low = low;
  }
  void pull_data(bool low) {
    if (data_low && !low && !clock_low && clocks >= holds) said += 'S';
    data_low = low;
  }
};

struct Wire {
  Bus* bus;
  bool is_clock;
  void pull_down(bool low) const {
    if (is_clock) return bus->pull_clock(low);
    bus->pull_data(low);
  }
  [[nodiscard]] bool high() const { return is_clock ? !bus->clock_low : (!bus->data_low && bus->clocks >= bus->holds); }
};

std::string freed(int holds) {
  Bus bus;
  bus.holds = holds;
  free_wires(Wire{&bus, true}, Wire{&bus, false}, [] {});
  EXPECT_FALSE(bus.clock_low || bus.data_low);
  return bus.said;
}

TEST(FreeWires, AFreeBusGetsAStopAndNoClock) { EXPECT_EQ(freed(0), "S"); }
TEST(FreeWires, ADeviceInAByteGetsItsClocksAndAStop) {
  EXPECT_EQ(freed(3), "cccS");
  EXPECT_EQ(freed(9), "cccccccccS");
}
TEST(FreeWires, NoMoreThanNineClocksForAWireThatIsHeldForEver) { EXPECT_EQ(freed(1000), "ccccccccc"); }

}  // namespace
}  // namespace fencepost::mcu
