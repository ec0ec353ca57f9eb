#include "drivers/can_wheels/odometry.hpp"

#include <gtest/gtest.h>

#include "drivers/can_wheels/layouts.hpp"
#include "hal/fake/scripted_can.hpp"

namespace fencepost::can_wheels {
namespace {

using base::Error;
using sensor::LinkState;

static_assert(sensor::OdometrySource<Odometry<fake::ScriptedCan>>);

Mapping canopen() {
  Mapping mapping;
  mapping.left = canopen_position(5);
  mapping.right = canopen_position(6);
  mapping.wheels = {1'000'000'000, 1'000'000'000, 200'000'000'000, 32};
  return mapping;
}

bus::CanFrame position(std::uint32_t id, std::uint8_t count) {
  return {id, false, false, 6, {0x37, 0x06, count, 0, 0, 0}, {}};
}

// Left at 10, 30 and 50 ms, right at 20 and 40 ms, one count each 10 ms: in step.
TEST(CanOdometry, WheelsInFramesOfTheirOwn) {
  const std::array<fake::CanStep, 5> script = {{{base::Time{100}, position(0x185, 1), {}},
                                                {base::Time{200}, position(0x186, 2), {}},
                                                {base::Time{300}, position(0x185, 3), {}},
                                                {base::Time{400}, position(0x186, 4), {}},
                                                {base::Time{500}, position(0x185, 5), {}}}};
  fake::SteppedClock clock;
  fake::ScriptedCan bus(script, clock);
  Odometry<fake::ScriptedCan> odometry(bus, canopen());
  std::vector<sensor::OdometrySample> samples;
  for (int ms = 0; ms < 60; ++ms) {
    if (const auto sample = odometry.poll(clock.now())) samples.push_back(*sample);
    clock.advance(base::milliseconds(1));
  }
  ASSERT_EQ(samples.size(), 2U);
  EXPECT_EQ(samples[0].t, base::Time{200});
  EXPECT_EQ(samples[1].t, base::Time{400});
  EXPECT_EQ(samples[1].x.raw, 20);
  EXPECT_EQ(samples[1].heading.raw, 0);
  EXPECT_EQ(odometry.link(), LinkState::kOk);
}

TEST(CanOdometry, TheTimeOfTheBusCounts) {
  bus::CanFrame stamped = position(0x185, 1);
  stamped.received = base::Time{95};
  Mapping mapping = canopen();
  mapping.right = mapping.left;
  const std::array<fake::CanStep, 2> script = {{{base::Time{100}, stamped, {}}, {base::Time{100}, stamped, {}}}};
  fake::SteppedClock clock(base::Time{100});
  fake::ScriptedCan bus(script, clock);
  Odometry<fake::ScriptedCan> odometry(bus, mapping);
  EXPECT_EQ(odometry.poll(clock.now())->t, base::Time{95});
  EXPECT_EQ(odometry.poll(clock.now()).error(), Error::kNotReady);  // no later than the last
}

TEST(CanOdometry, ErrorsSilenceAndUnplug) {
  const std::array<fake::CanStep, 3> script = {{{base::Time{0}, {}, Error::kBadInput},
                                                {base::Time{0}, position(0x185, 1), {}},
                                                {base::Time{0}, position(0x186, 1), {}}}};
  fake::SteppedClock clock;
  fake::ScriptedCan bus(script, clock);
  Odometry<fake::ScriptedCan> odometry(bus, canopen());
  EXPECT_EQ(odometry.link(), LinkState::kSilent);
  (void)odometry.poll(clock.now());
  EXPECT_EQ(odometry.bus_errors(), 1U);
  EXPECT_EQ(odometry.link(), LinkState::kOk);
  clock.advance(base::milliseconds(301));
  (void)odometry.poll(clock.now());
  EXPECT_EQ(odometry.link(), LinkState::kSilent);
  bus.unplug();
  (void)odometry.poll(clock.now());
  EXPECT_EQ(odometry.link(), LinkState::kAbsent);
  bus.replug();
  (void)odometry.poll(clock.now());
  EXPECT_EQ(odometry.link(), LinkState::kSilent);
}

// A bus that only ever reports errors does not hold the loop.
TEST(CanOdometry, AnEndlessRowOfErrorsEndsTheTurn) {
  struct BadBus {
    static base::Result<bus::CanFrame> receive() { return Error::kBadInput; }
  } bus;
  Odometry<BadBus> odometry(bus, canopen());
  EXPECT_EQ(odometry.poll({}).error(), Error::kNotReady);
  EXPECT_EQ(odometry.bus_errors(), 32U);
}

}  // namespace
}  // namespace fencepost::can_wheels
