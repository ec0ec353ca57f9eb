#include "hal/fake/scripted_i2c.hpp"

#include <gtest/gtest.h>

namespace fencepost::fake {
namespace {

using base::Error;

constexpr std::array<std::uint8_t, 3> kBytes = {1, 2, 3};

TEST(ScriptedI2c, PlaysOneStepATransfer) {
  const std::array<I2cStep, 2> script = {{{kBytes, {}, 1}, {{}, Error::kBadInput, 0}}};
  ScriptedI2c<4> bus(script);
  std::array<std::uint8_t, 4> in{};
  EXPECT_EQ(bus.finish(in).error(), Error::kNotReady);
  EXPECT_EQ(bus.begin(0x20, kBytes, 2).value(), 3U);
  EXPECT_EQ(bus.begin(0x20, kBytes, 2).error(), Error::kFull);
  EXPECT_EQ(bus.finish(in).error(), Error::kNotReady);
  EXPECT_EQ(bus.finish(in).value(), 2U);  // no more than was asked for
  EXPECT_EQ(in[1], 2);
  EXPECT_EQ(bus.begin(0x21, {}, 1).value(), 0U);
  EXPECT_EQ(bus.finish(in).error(), Error::kBadInput);
  EXPECT_TRUE(bus.finished());
  ASSERT_EQ(bus.transfers().size(), 2U);
  EXPECT_EQ(bus.transfers()[0].out.size(), 3U);
  EXPECT_EQ(bus.transfers()[1].address, 0x21);
}

TEST(ScriptedI2c, RefusesAfterTheScriptAndIsGoneUnplugged) {
  ScriptedI2c<4> bus({});
  std::array<std::uint8_t, 4> in{};
  EXPECT_TRUE(bus.begin(1, {}, 4));
  EXPECT_EQ(bus.finish(in).error(), Error::kRefused);
  EXPECT_EQ(bus.begin(1, std::array<std::uint8_t, 33>{}, 0).error(), Error::kFull);
  EXPECT_TRUE(bus.begin(1, {}, 4));
  bus.unplug();
  EXPECT_EQ(bus.finish(in).error(), Error::kGone);
  EXPECT_EQ(bus.begin(1, {}, 4).error(), Error::kGone);
  bus.replug();
  EXPECT_TRUE(bus.begin(1, {}, 4));
}

}  // namespace
}  // namespace fencepost::fake
