// One hour on a bad bus. 1 % of the frames are lost to bus errors; every 20 s comes a stall, a restart of the
// controllers or an unplug. CAN's own checksum leaves no damaged frame: frames that come are right, and so is the way
// driven.
#include <gtest/gtest.h>

#include "tests/drivers/bench/can_rig.hpp"
#include "tests/drivers/bench/faults.hpp"

namespace fencepost::can_wheels {
namespace {

TEST(CanHostile, ALostFrameCostsNoWay) {
  constexpr base::Duration kStep = base::milliseconds(1);
  test::Bench<test::CanRig> bench(test::Damage{0.0025, 11});  // four bytes a frame: 1 % of the frames
  test::Faults faults(12);
  base::Duration in_fault{};
  sensor::OdometrySample pose;
  bench.moving = true;
  while (bench.clock.now() < base::Time{} + base::milliseconds(3'600'000)) {
    const base::Time now = bench.clock.now();
    switch (faults.begin(now)) {
      case test::Faults::Kind::kNone: break;
      case test::Faults::Kind::kStall: bench.link.stall(); break;
      case test::Faults::Kind::kReboot: bench.restart(now); break;
      case test::Faults::Kind::kUnplug: bench.link.unplug(); break;
    }
    if (faults.over(now)) bench.link.resume(), bench.link.replug();
    if (!faults.over(now)) in_fault = in_fault + kStep;
    if (const auto sample = bench.step(kStep)) pose = *sample;
  }
  const double way = 3'600 * 1'000 * 3.14159265 * 0.1 / 4'096;
  const double lost_way = way * static_cast<double>(in_fault.raw + faults.count() * 8'000) / 36'000'000.0;
  EXPECT_GT(faults.count(), 100U);
  EXPECT_GT(bench.link.corrupted(), 2'000U);
  EXPECT_GT(pose.x.to_double(), way - lost_way);
  EXPECT_LT(pose.x.to_double(), way + 0.01);
  EXPECT_NEAR(pose.heading.to_double(), 0, 0.02);
}

}  // namespace
}  // namespace fencepost::can_wheels
