#include "hal/fake/scripted_can.hpp"

#include <gtest/gtest.h>

#include <array>

namespace fencepost::fake {
namespace {

using base::Error;

TEST(ScriptedCan, GivesFramesWhenTheirTimeHasCome) {
  const bus::CanFrame frame{0x185, false, false, 2, {1, 2}, {}};
  const std::array<CanStep, 2> script = {{{base::Time{20}, frame, {}}, {base::Time{20}, {}, Error::kBadInput}}};
  SteppedClock clock;
  ScriptedCan bus(script, clock);
  EXPECT_EQ(bus.receive().error(), Error::kNotReady);
  clock.advance(base::milliseconds(2));
  bus.unplug();
  EXPECT_EQ(bus.receive().error(), Error::kGone);
  bus.replug();
  EXPECT_EQ(bus.receive().value(), frame);
  EXPECT_FALSE(bus.finished());
  EXPECT_EQ(bus.receive().error(), Error::kBadInput);
  EXPECT_TRUE(bus.finished());
  EXPECT_EQ(bus.receive().error(), Error::kNotReady);
}

}  // namespace
}  // namespace fencepost::fake
