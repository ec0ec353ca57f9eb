// One hour on a bad bus: 1 % of the frames lost to bus errors, and every 20 s a stall, a restart of the controllers or
// an unplug. CAN's own checksum leaves no damaged frame: what comes is right.
#include <gtest/gtest.h>

#include <deque>
#include <random>

#include "drivers/can_wheels/layouts.hpp"
#include "drivers/can_wheels/odometry.hpp"
#include "host/emulate/can_wheels.hpp"
#include "tests/drivers/faults.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace fencepost::can_wheels {
namespace {

using test::Faults;

struct HostileBus {
  base::Result<bus::CanFrame> receive() {
    if (unplugged) return base::Error::kGone;
    if (waiting.empty()) return base::Error::kNotReady;
    const bus::CanFrame frame = waiting.front();
    waiting.pop_front();
    if (random() % 100 == 0) return ++lost, base::Error::kBadInput;
    return frame;
  }
  std::deque<bus::CanFrame> waiting;
  bool unplugged = false;
  std::uint32_t lost = 0;
  std::mt19937 random{11};
};

TEST(CanHostile, ALostFrameCostsNoWay) {
  emulate::CanWheels device(emulate::CanWheels::Kind::kTalonSrx, base::Time{});
  HostileBus bus;
  Mapping mapping;
  mapping.left = talon_srx_position(3);
  mapping.right = talon_srx_position(4);
  mapping.wheels = odometry::make_wheel_base({100, 4'096}, 500, 24);
  Odometry<HostileBus> odometry(bus, mapping);
  Faults faults(12);
  std::uint32_t samples = 0;
  base::Time now{};
  base::Time last{};
  base::Duration gap{};
  base::Duration in_fault{};
  sensor::OdometrySample pose;
  for (std::int64_t ms = 0; ms < 3'600'000; ++ms) {
    now = now + base::milliseconds(1);
    const Faults::Kind begun = faults.begin(now);
    if (begun == Faults::Kind::kReboot) device.restart(now);
    if (begun == Faults::Kind::kUnplug) bus.unplugged = true;
    const bool stalled = !faults.over(now) && !bus.unplugged;
    if (faults.over(now)) bus.unplugged = false;
    // 1000 counts a second: 76.7 mm/s, straight on.
    device.turn(static_cast<std::int32_t>(ms), static_cast<std::int32_t>(ms), 100, 100);
    for (const bus::CanFrame& frame : device.frames(now)) {
      if (!stalled && !bus.unplugged) bus.waiting.push_back(frame);
    }
    if (!faults.over(now)) in_fault = in_fault + base::milliseconds(1);
    if (faults.quiet(now) > base::milliseconds(1'000)) gap = std::max(gap, now - last);
    const auto sample = odometry.poll(now);
    if (!sample) continue;
    ++samples;
    last = now;
    EXPECT_GT(sample->t, pose.t);
    pose = *sample;
  }
  const double way = 3'600 * 1'000 * 3.14159265 * 0.1 / 4'096;
  const double lost_way = way * static_cast<double>(in_fault.raw + faults.count() * 8'000) / 36'000'000.0;
  std::printf(
      "samples %u, %u frames lost, %u faults, longest gap %.3f s; way %.1f m of %.1f m, in faults at most %.1f m\n",
      samples, bus.lost, faults.count(), static_cast<double>(gap.raw) * 1e-4, pose.x.to_double(), way, lost_way);
  EXPECT_GT(faults.count(), 100U);
  EXPECT_GT(samples, 160'000U);
  EXPECT_GT(bus.lost, 2'000U);
  EXPECT_LT(gap, base::milliseconds(150));
  EXPECT_GT(pose.x.to_double(), way - lost_way);
  EXPECT_LT(pose.x.to_double(), way + 0.01);
  EXPECT_NEAR(pose.heading.to_double(), 0, 0.02);
}

TEST(CanHostile, FuzzedShortly) {
  std::mt19937 random(13);
  for (int i = 0; i < 500; ++i) {
    std::vector<std::uint8_t> bytes(600);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
    ASSERT_EQ(LLVMFuzzerTestOneInput(bytes.data(), bytes.size()), 0);
  }
}

}  // namespace
}  // namespace fencepost::can_wheels
