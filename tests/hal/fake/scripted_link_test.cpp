#include "hal/fake/scripted_link.hpp"

#include <gtest/gtest.h>

#include <array>

namespace fencepost::fake {
namespace {

using base::Error;

constexpr std::array<std::uint8_t, 3> kFirst = {1, 2, 3};
constexpr std::array<std::uint8_t, 1> kSecond = {4};

TEST(ScriptedLink, DeliversStepByStep) {
  const std::array<LinkStep, 3> script = {{{kFirst, {}}, {{}, Error::kNotReady}, {kSecond, {}}}};
  ScriptedLink<8> link(script);
  std::array<std::uint8_t, 8> buffer{};
  EXPECT_EQ(link.read(buffer).value(), 3U);
  EXPECT_EQ(buffer[2], 3);
  EXPECT_EQ(link.read(buffer).error(), Error::kNotReady);
  EXPECT_EQ(link.read(buffer).value(), 1U);
  EXPECT_EQ(buffer[0], 4);
  EXPECT_EQ(link.read(buffer).error(), Error::kNotReady);
  EXPECT_TRUE(link.finished());
}

TEST(ScriptedLink, SplitsAStepOverSmallReads) {
  const std::array<LinkStep, 2> script = {{{kFirst, {}}, {kSecond, {}}}};
  ScriptedLink<8> link(script);
  std::array<std::uint8_t, 2> buffer{};
  EXPECT_EQ(link.read(buffer).value(), 2U);
  EXPECT_EQ(link.read(buffer).value(), 1U);
  EXPECT_EQ(buffer[0], 3);
  EXPECT_EQ(link.read(buffer).value(), 1U);
  EXPECT_EQ(buffer[0], 4);
}

TEST(ScriptedLink, GivesEachFaultOnce) {
  const std::array<LinkStep, 2> script = {{{{}, Error::kGone}, {kSecond, {}}}};
  ScriptedLink<8> link(script);
  std::array<std::uint8_t, 2> buffer{};
  EXPECT_EQ(link.read(buffer).error(), Error::kGone);
  EXPECT_EQ(link.read(buffer).value(), 1U);
}

TEST(ScriptedLink, KeepsWhatIsWrittenAndRefusesTheRest) {
  ScriptedLink<4> link({});
  EXPECT_EQ(link.write(kFirst).value(), 3U);
  EXPECT_EQ(link.write(kFirst).value(), 1U);
  EXPECT_EQ(link.write(kFirst).error(), Error::kFull);
  ASSERT_EQ(link.written().size(), 4U);
  EXPECT_EQ(link.written()[3], 1);
}

TEST(ScriptedLink, LimitsItsWrites) {
  ScriptedLink<8> link({});
  link.limit_writes(2);
  EXPECT_EQ(link.write(kFirst).value(), 2U);
  link.limit_writes(0);
  EXPECT_EQ(link.write(kFirst).error(), Error::kFull);
}

TEST(ScriptedLink, ComesBackAfterAnUnplug) {
  ScriptedLink<8> link({});
  link.unplug();
  EXPECT_EQ(link.write(kFirst).error(), Error::kGone);
  link.replug();
  EXPECT_EQ(link.write(kFirst).value(), 3U);
}

}  // namespace
}  // namespace fencepost::fake
