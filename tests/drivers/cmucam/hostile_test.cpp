// An hour on a line that damages one byte in a hundred, stalls, and loses its plug; a camera that is switched off and
// on.
#include <gtest/gtest.h>

#include "tests/drivers/cmucam/rig.hpp"

namespace fencepost::cmucam {
namespace {

using emulate::CmuCamModel;

constexpr base::Duration kMinute = base::milliseconds(60'000);

struct Tally {
  std::uint32_t frames = 0;
  std::uint32_t wrong = 0;  ///< frames that are not what the camera saw: damage that nothing can notice
};

bool is_right(const sensor::BlobFrame& frame) {
  const auto same = [](const sensor::Blob& blob, int x1, int y1, int x2, int y2) {
    return blob.x1 == x1 && blob.y1 == y1 && blob.x2 == x2 && blob.y2 == y2;
  };
  if (frame.blobs.size() != 2) return false;
  const std::size_t red = frame.blobs[0].signature == 1 ? 0 : 1;
  return same(frame.blobs[red], 20, 40, 29, 59) && same(frame.blobs[1 - red], 50, 60, 59, 89);
}

Tally tally(const std::vector<sensor::BlobFrame>& frames) {
  Tally sum;
  base::Time last{-1};
  for (const sensor::BlobFrame& frame : frames) {
    EXPECT_LT(last, frame.t);
    last = frame.t;
    ++sum.frames;
    sum.wrong += is_right(frame) ? 0U : 1U;
  }
  return sum;
}

class HostileCmuCam : public testing::TestWithParam<std::pair<CmuCamModel, const Dialect*>> {};

TEST_P(HostileCmuCam, AnHourOfEverything) {
  Rig rig(two_windows(*GetParam().second), GetParam().first, 7);
  rig.spots = red_and_blue();
  rig.wire.damage_one_byte_in(100);
  Tally sum;
  for (int minute = 0; minute < 60; ++minute) {
    switch (minute % 6) {
      case 1: rig.wire.stall(true); break;
      case 2: rig.wire.unplug(); break;
      case 3: rig.switch_off(); break;
      default: break;
    }
    (void)rig.run(base::milliseconds(300 + static_cast<std::int64_t>(rig.wire.random()() % 5'000)));
    rig.wire.stall(false);
    rig.wire.replug();
    if (!rig.powered) rig.switch_on();
    const Tally part = tally(rig.run(kMinute));
    EXPECT_GT(part.frames, 60U) << "minute " << minute << ": did not come back";
    sum.frames += part.frames;
    sum.wrong += part.wrong;
  }
  RecordProperty("frames", static_cast<int>(sum.frames));
  RecordProperty("undetected", static_cast<int>(sum.wrong));
  EXPECT_GT(sum.frames, 12'000U);
  EXPECT_GT(sum.wrong, 0U) << "no checksum: some damage must get through, or there was none";
  EXPECT_LT(sum.wrong, sum.frames / 10);
}

// One damaged byte at a time, far apart, once the camera is tracking: one answer is lost or, undetected, wrong; a
// question whose prompt went missing also costs its time-out, in which up to five frames are not asked for.
TEST_P(HostileCmuCam, ADamagedByteCostsATimeOutAtMostAndNoReset) {
  Rig rig(two_windows(*GetParam().second), GetParam().first, 3);
  rig.spots = red_and_blue();
  ASSERT_FALSE(rig.run(base::milliseconds(3'000)).empty());
  std::uint32_t lost_and_wrong = 0;
  std::uint32_t damaged = 0;
  const std::size_t undisturbed = rig.run(base::milliseconds(6'000)).size();
  for (int round = 0; round < 100; ++round) {
    // Six seconds with one byte damaged in the first: a re-asked question takes up to 0.4 s, three frames of two
    // windows.
    const std::uint32_t before = rig.wire.damaged_bytes();
    Tally part;
    rig.wire.damage_one_byte_in(1 + static_cast<std::uint32_t>(rig.wire.random()() % 60));
    std::vector<sensor::BlobFrame> frames;
    while (rig.wire.damaged_bytes() == before) {
      if (const auto frame = rig.step()) frames.push_back(*frame);
    }
    rig.wire.damage_one_byte_in(0);
    damaged += rig.wire.damaged_bytes() - before;
    part = tally(frames);
    const Tally rest = tally(rig.run(base::milliseconds(6'000)));
    ASSERT_GE(rest.frames + 5, undisturbed) << round;
    ASSERT_LE(part.wrong + rest.wrong, rig.wire.damaged_bytes() - before) << round;
    lost_and_wrong += part.wrong + rest.wrong;
  }
  EXPECT_GE(damaged, 100U);
  EXPECT_LT(lost_and_wrong, damaged / 3);
  EXPECT_EQ(rig.driver.session().counts().resets, 1U) << "none of them was worth a reset";
}

INSTANTIATE_TEST_SUITE_P(All, HostileCmuCam,
                         testing::Values(std::pair{CmuCamModel::kOne, &kCmuCam1},
                                         std::pair{CmuCamModel::kTwo, &kCmuCam2},
                                         std::pair{CmuCamModel::kThree, &kCmuCam3},
                                         std::pair{CmuCamModel::kFour, &kCmuCam4}));

}  // namespace
}  // namespace fencepost::cmucam
