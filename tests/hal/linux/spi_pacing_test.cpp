#include "hal/linux/spi_pacing.hpp"

#include <gtest/gtest.h>

#include <array>

namespace fencepost::linux {
namespace {

using base::milliseconds;
using base::Time;

TEST(SpiPacing, GrantsNothingBeforeItIsTended) {
  SpiPacing pacing;
  EXPECT_EQ(pacing.use(10), 0U);
}

TEST(SpiPacing, GrantsSixtyFourBytesAMillisecond) {
  SpiPacing pacing;
  const Time start = Time{} + milliseconds(3);
  pacing.tend(start);
  EXPECT_EQ(pacing.use(40), 40U);
  EXPECT_EQ(pacing.use(40), 24U);
  EXPECT_EQ(pacing.use(40), 0U);
  pacing.tend(start + base::Duration{9});
  EXPECT_EQ(pacing.use(40), 0U);
  pacing.tend(start + base::Duration{10});
  EXPECT_EQ(pacing.use(1000), 64U);
}

TEST(SpiPacing, DoesNotSaveUpGrants) {
  SpiPacing pacing;
  pacing.tend(Time{});
  pacing.tend(Time{} + milliseconds(1000));
  EXPECT_EQ(pacing.use(1000), 64U);
}

TEST(SpiPacing, GivesBackWhatItKeptInOrder) {
  SpiPacing pacing;
  const std::array<std::uint8_t, 3> came = {7, 8, 9};
  pacing.keep(came);
  EXPECT_EQ(pacing.room(), 61U);
  std::array<std::uint8_t, 2> in{};
  EXPECT_EQ(pacing.take(in), 2U);
  EXPECT_EQ(in, (std::array<std::uint8_t, 2>{7, 8}));
  EXPECT_EQ(pacing.take(in), 1U);
  EXPECT_EQ(in[0], 9);
  EXPECT_EQ(pacing.take(in), 0U);
  pacing.keep(came);
  pacing.forget();
  EXPECT_EQ(pacing.take(in), 0U);
}

}  // namespace
}  // namespace fencepost::linux
