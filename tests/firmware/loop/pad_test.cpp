// Boxes that are too wide: what $FPSIG says of a colour is taken off before anything looks at them.
#include <gtest/gtest.h>

#include <memory>

#include "firmware/loop/pipeline.hpp"
#include "tests/firmware/level_pixy2.hpp"
#include "tests/firmware/loop/desk.hpp"
#include "tests/firmware/recon/guard/flat_world.hpp"

namespace fencepost::test {
namespace {

constexpr std::int8_t kPadded = 4;  // px

/// All frames of the approach, each side `by` px further out.
Script padded(Script script, std::int16_t by) {
  for (fake::CameraStep& step : script.camera) {
    sensor::BlobFrame frame = *step.answer;
    for (sensor::Blob& blob : frame.blobs) {
      blob.x1 = static_cast<std::int16_t>(blob.x1 - by);
      blob.y1 = static_cast<std::int16_t>(blob.y1 - by);
      blob.x2 = static_cast<std::int16_t>(blob.x2 + by);
      blob.y2 = static_cast<std::int16_t>(blob.y2 + by);
    }
    step.answer = frame;
  }
  return script;
}

template <class Profile>
struct PaddedRobot {
  explicit PaddedRobot(std::int8_t pad) {
    pipeline.start_run(header);
    pipeline.set_camera(level_pixy2());
    pipeline.set_signature({1, {}, "red", pad});
  }
  void drive(const Script& script) {
    for (std::size_t i = 0; i < script.camera.size(); ++i) {
      pipeline.accept(*script.odometry[i].answer);
      pipeline.accept(*script.camera[i].answer);
      settle();
    }
  }
  void settle() {
    while (pipeline.place_next_frame()) {
    }
    pipeline.watch_without_frames();
    memory->output.taken(memory->output.waiting().size());
  }

  std::unique_ptr<loop::Memory<Profile>> memory = std::make_unique<loop::Memory<Profile>>();
  loop::Pipeline<Profile> pipeline{*memory, console::Mode::kQuiet};
  record::Header header{1, "fencepost", "0.0.0", "test", Profile::kName};
};

template <class Profile>
class Pad : public testing::Test {};
using PadProfiles = testing::Types<config::Micro, config::Small, config::Full>;
TYPED_TEST_SUITE(Pad, PadProfiles);

TYPED_TEST(Pad, ConfiguredItLeavesTheMapOfBareBoxes) {
  const Script bare = desk_approach(400);
  PaddedRobot<TypeParam> plain(0);
  PaddedRobot<TypeParam> configured(kPadded);
  PaddedRobot<TypeParam> not_configured(0);
  plain.drive(bare);
  configured.drive(padded(bare, kPadded));
  not_configured.drive(padded(bare, kPadded));
  ASSERT_NE(plain.memory->map.digest(), 0U);
  EXPECT_EQ(configured.memory->map.digest(), plain.memory->map.digest());
  EXPECT_NE(not_configured.memory->map.digest(), plain.memory->map.digest());
}

TYPED_TEST(Pad, IsOfItsColourAndNotOfBearings) {
  PaddedRobot<TypeParam> robot(kPadded);
  sensor::BlobFrame frame{base::Time::nearest(1), 1, {}};
  sensor::Blob bearing{1, 0, 100, 0, 120, base::Pixels1::nearest(80), {}, 0, {}, true};
  sensor::put_at_centre(bearing);
  static_cast<void>(frame.blobs.push_back({2, 40, 100, 60, 120, {}, {}, 0, {}, false}));
  static_cast<void>(frame.blobs.push_back(bearing));
  // Of these two the narrow one comes first once their pads are off.
  static_cast<void>(frame.blobs.push_back({1, 100, 100, 140, 120, {}, {}, 0, {}, false}));
  static_cast<void>(frame.blobs.push_back({1, 101, 100, 103, 120, {}, {}, 0, {}, false}));
  robot.pipeline.accept(frame);
  ASSERT_EQ(robot.memory->waiting.size(), 1U);
  const auto& blobs = robot.memory->waiting[0].blobs;
  ASSERT_EQ(blobs.size(), 4U);
  EXPECT_TRUE(blobs[0].bearing && blobs[0].box.x1 == 80 && blobs[0].box.x2 == 80 && blobs[0].box.y1 == 100);
  EXPECT_TRUE(blobs[1].box.x1 == 102 && blobs[1].box.x2 == 102 && blobs[1].box.y1 == 104 && blobs[1].box.y2 == 116);
  EXPECT_TRUE(blobs[2].box.x1 == 104 && blobs[2].box.x2 == 136);
  EXPECT_TRUE(blobs[3].box.x1 == 40 && blobs[3].box.x2 == 60 && blobs[3].box.y1 == 100);
}

// Its boxes jump, but nothing comes closer.
TYPED_TEST(Pad, ThatChangesIsNoApproach) {
  PaddedRobot<TypeParam> robot(0);
  std::uint32_t number = 0;
  const auto stand = [&](double until) {
    for (; number < 25 * until; ++number) {
      const double t = 0.04 * number;
      robot.pipeline.accept(sensor::OdometrySample{base::Time::nearest(t), {}, {}, {}});
      robot.pipeline.accept(flat_view({{0.6, -0.04, 0.04}}, 0, 0, t, number));
      robot.settle();
      ASSERT_NE(robot.pipeline.in_force().level, record::AlertLevel::kStop) << t << " s";
    }
  };
  stand(2);
  for (std::int8_t pad = 0; pad > -20; pad = static_cast<std::int8_t>(pad - 4)) {
    robot.pipeline.set_signature({1, {}, "red", pad});
    stand(0.04 * number + 0.08);
  }
}

}  // namespace
}  // namespace fencepost::test
