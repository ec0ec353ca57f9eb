#include "hal/sensor/sources.hpp"

#include <gtest/gtest.h>

#include "hal/bus/byte_link.hpp"
#include "hal/bus/clock.hpp"
#include "hal/fake/scripted_link.hpp"
#include "hal/fake/scripted_source.hpp"
#include "hal/fake/stepped_clock.hpp"

namespace fencepost::sensor {
namespace {

// The seams accept what keeps the contract, and refuse what does not: a concept that takes everything checks nothing.
static_assert(BlobCamera<fake::ScriptedCamera>);
static_assert(OdometrySource<fake::ScriptedOdometry>);
static_assert(bus::ByteLink<fake::ScriptedLink<16>>);
static_assert(bus::Clock<fake::SteppedClock>);

static_assert(!BlobCamera<fake::ScriptedOdometry>);
static_assert(!OdometrySource<fake::ScriptedCamera>);
static_assert(!bus::ByteLink<fake::SteppedClock>);

struct WaitingCamera {
  BlobFrame poll(base::Time now);  // cannot say "not ready", so it would have to wait
  [[nodiscard]] LinkState link() const;
  [[nodiscard]] std::uint32_t dropped() const;
};
static_assert(!BlobCamera<WaitingCamera>);

struct ClockThatMovesItself {
  base::Time now();
};
static_assert(!bus::Clock<ClockThatMovesItself>);

TEST(BlobFrame, HoldsSixteenBlobsAndRefusesTheNext) {
  BlobFrame frame;
  for (std::size_t i = 0; i < kMaxBlobs; ++i) EXPECT_TRUE(frame.blobs.push_back(Blob{}));
  EXPECT_FALSE(frame.blobs.push_back(Blob{}));
}

}  // namespace
}  // namespace fencepost::sensor
