#include "hal/fake/scripted_source.hpp"

#include <gtest/gtest.h>

#include <array>

namespace fencepost::fake {
namespace {

using base::Error;
using sensor::LinkState;

TEST(ScriptedCamera, AnswersWhenItsTimeHasCome) {
  sensor::BlobFrame frame;
  frame.t = base::Time{200};
  frame.frame = 7;
  const std::array<CameraStep, 2> script = {{{base::Time{200}, frame, LinkState::kOk, 3},  //
                                             {base::Time{300}, Error::kBadInput, LinkState::kUnready, 1}}};
  ScriptedCamera camera(script);
  EXPECT_EQ(camera.link(), LinkState::kSilent);
  EXPECT_EQ(camera.poll(base::Time{199}).error(), Error::kNotReady);
  EXPECT_EQ(camera.poll(base::Time{200}).value(), frame);
  EXPECT_EQ(camera.link(), LinkState::kOk);
  EXPECT_EQ(camera.dropped(), 3U);
  EXPECT_EQ(camera.poll(base::Time{200}).error(), Error::kNotReady);
  EXPECT_EQ(camera.poll(base::Time{999}).error(), Error::kBadInput);
  EXPECT_EQ(camera.link(), LinkState::kUnready);
  EXPECT_EQ(camera.dropped(), 4U);
  EXPECT_TRUE(camera.finished());
  EXPECT_EQ(camera.poll(base::Time{999}).error(), Error::kNotReady);
}

TEST(ScriptedOdometry, CatchesUpOneSampleAPoll) {
  const sensor::OdometrySample first{base::Time{100}, base::Metres{1}, base::Metres{2}, base::Radians{3}};
  const sensor::OdometrySample second{base::Time{200}, base::Metres{4}, base::Metres{5}, base::Radians{6}};
  const std::array<OdometryStep, 2> script = {{{base::Time{100}, first}, {base::Time{200}, second}}};
  ScriptedOdometry odometry(script);
  EXPECT_EQ(odometry.poll(base::Time{500}).value(), first);
  EXPECT_EQ(odometry.poll(base::Time{500}).value(), second);
  EXPECT_EQ(odometry.poll(base::Time{500}).error(), Error::kNotReady);
}

}  // namespace
}  // namespace fencepost::fake
