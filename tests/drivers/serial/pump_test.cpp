#include "drivers/serial/pump.hpp"

#include <gtest/gtest.h>

#include <array>

#include "drivers/serial/outbox.hpp"
#include "hal/fake/scripted_link.hpp"
#include "hal/sensor/odometry.hpp"

namespace fencepost::serial {
namespace {

using base::Error;
using fake::LinkStep;
using sensor::LinkState;

/// Every byte '!' completes a sample that carries the number of bytes so far; greets with "hi" at its first step.
struct Counting {
  using Sample = sensor::OdometrySample;

  explicit Counting(int /*config*/) {}
  bool take(std::uint8_t byte, base::Time now) {
    latest.t = now;
    ++latest.x.raw;
    return byte == '!';
  }
  [[nodiscard]] const Sample& sample() const { return latest; }
  void step(base::Time /*now*/) {
    if (!greeted) greeted = out.put("hi");
  }
  void link_lost() {
    ++losses;
    greeted = false;
  }
  Outbox<8>& outbox() { return out; }
  [[nodiscard]] LinkState link() const { return LinkState::kOk; }

  Sample latest;
  Outbox<8> out;
  bool greeted = false;
  int losses = 0;
};

constexpr std::array<std::uint8_t, 5> kTwoSamples = {'a', '!', 'b', '!', 'c'};
constexpr std::array<std::uint8_t, 1> kOne = {'!'};

using TestPump = Pump<fake::ScriptedLink<16>, Counting>;

TEST(Pump, GivesOneSampleAPollAndKeepsTheRest) {
  const std::array<LinkStep, 2> script = {{{kTwoSamples, {}}, {kOne, {}}}};
  fake::ScriptedLink<16> link(script);
  TestPump pump(link, 0);
  const auto first = pump.poll({10});
  EXPECT_EQ(first->x.raw, 2);
  EXPECT_EQ(first->t.raw, 10);
  // The second came with the first and shares its time: dropped. The third came later.
  const auto third = pump.poll({20});
  EXPECT_EQ(third->x.raw, 6);
  EXPECT_EQ(third->t.raw, 20);
  EXPECT_EQ(pump.stale(), 1U);
  EXPECT_EQ(pump.poll({30}).error(), Error::kNotReady);
}

TEST(Pump, WritesWhatTheLinkTakes) {
  fake::ScriptedLink<16> link({});
  link.limit_writes(1);
  TestPump pump(link, 0);
  (void)pump.poll({10});
  EXPECT_EQ(link.written().size(), 1U);
  (void)pump.poll({20});
  (void)pump.poll({30});
  EXPECT_EQ(std::string(link.written().begin(), link.written().end()), "hi");
}

TEST(Pump, TellsOfAnUnpluggedLinkOnce) {
  const std::array<LinkStep, 4> script = {{{{}, Error::kGone}, {{}, Error::kGone}, {{}, Error::kNotReady}, {kOne, {}}}};
  fake::ScriptedLink<16> link(script);
  TestPump pump(link, 0);
  EXPECT_FALSE(pump.poll({10}).ok());
  EXPECT_EQ(pump.link(), LinkState::kAbsent);
  EXPECT_FALSE(pump.poll({20}).ok());
  EXPECT_EQ(pump.session().losses, 1);
  EXPECT_FALSE(pump.poll({30}).ok());
  EXPECT_EQ(pump.link(), LinkState::kOk);
  EXPECT_TRUE(pump.poll({40}).ok());
  EXPECT_EQ(pump.faults(), 0U);
}

TEST(Pump, AWriteMayFindTheLinkGone) {
  fake::ScriptedLink<16> link({});
  link.unplug();
  TestPump pump(link, 0);
  (void)pump.poll({10});
  EXPECT_EQ(pump.link(), LinkState::kAbsent);
  EXPECT_EQ(pump.session().losses, 1);
}

TEST(Pump, CountsOtherFaultsAndGoesOn) {
  const std::array<LinkStep, 2> script = {{{{}, Error::kBadInput}, {kOne, {}}}};
  fake::ScriptedLink<16> link(script);
  TestPump pump(link, 0);
  EXPECT_FALSE(pump.poll({10}).ok());
  EXPECT_EQ(pump.faults(), 1U);
  EXPECT_TRUE(pump.poll({20}).ok());
}

TEST(Pump, AFloodEndsThePollNotTheOtherWayRound) {
  constexpr std::array<std::uint8_t, 2'000> kFlood{};
  const std::array<LinkStep, 1> script = {{{kFlood, {}}}};
  fake::ScriptedLink<16> link(script);
  TestPump pump(link, 0);
  EXPECT_FALSE(pump.poll({10}).ok());
  EXPECT_EQ(pump.session().latest.x.raw, 512);
}

}  // namespace
}  // namespace fencepost::serial
