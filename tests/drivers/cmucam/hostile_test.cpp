// Two colours in turns, on a line that damages single bytes. Hostile hours are in tests/drivers/bench.
#include <gtest/gtest.h>

#include <random>

#include "tests/drivers/cmucam/rig.hpp"

namespace fencepost::cmucam {
namespace {

using emulate::CmuCamModel;

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

class DamagedCmuCam : public testing::TestWithParam<std::pair<CmuCamModel, const Dialect*>> {};

// One damaged byte at a time, far apart, once the camera is tracking: one answer is lost or, undetected, wrong; a
// question whose prompt went missing also costs its time-out, in which as many frames are not asked for.
TEST_P(DamagedCmuCam, ADamagedByteCostsATimeOutAtMostAndNoReset) {
  Rig rig(two_windows(*GetParam().second), GetParam().first, test::Damage{0, 3});
  std::mt19937 random(3);
  rig.scene = red_and_blue();
  ASSERT_FALSE(rig.run(base::milliseconds(3'000)).empty());
  std::uint32_t lost_and_wrong = 0;
  std::uint64_t damaged = 0;
  // A frame has two windows, an image each; two more for where the six seconds begin.
  const auto missed = static_cast<std::size_t>(GetParam().second->reply_timeout.raw / (2 * Rig::kImage.raw)) + 3;
  const std::size_t undisturbed = rig.run(base::milliseconds(6'000)).size();
  for (int round = 0; round < 100; ++round) {
    // Six seconds with one byte damaged in the first.
    const std::uint64_t before = rig.link.corrupted();
    Tally part;
    rig.link.corruptor().set(1.0 / static_cast<double>(1 + random() % 60));
    std::vector<sensor::BlobFrame> frames;
    while (rig.link.corrupted() == before) {
      if (const auto frame = rig.step()) frames.push_back(*frame);
    }
    rig.link.corruptor().set(0);
    damaged += rig.link.corrupted() - before;
    part = tally(frames);
    const Tally rest = tally(rig.run(base::milliseconds(6'000)));
    ASSERT_GE(rest.frames + missed, undisturbed) << round;
    ASSERT_LE(part.wrong + rest.wrong, rig.link.corrupted() - before) << round;
    lost_and_wrong += part.wrong + rest.wrong;
  }
  EXPECT_GE(damaged, 100U);
  EXPECT_LT(lost_and_wrong, damaged / 3);
  EXPECT_EQ(rig.driver.session().counts().resets, 1U) << "none of them was worth a reset";
}

INSTANTIATE_TEST_SUITE_P(All, DamagedCmuCam,
                         testing::Values(std::pair{CmuCamModel::kOne, &kCmuCam1},
                                         std::pair{CmuCamModel::kTwo, &kCmuCam2},
                                         std::pair{CmuCamModel::kThree, &kCmuCam3},
                                         std::pair{CmuCamModel::kFour, &kCmuCam4}));

}  // namespace
}  // namespace fencepost::cmucam
