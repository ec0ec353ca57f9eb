// What a robot was told survives a reset.
#include "firmware/image/keeper.hpp"

#include <gtest/gtest.h>

#include "hal/fake/cut_flash.hpp"
#include "tests/firmware/loop/desk.hpp"

namespace fencepost::image {
namespace {

using Flash = fake::CutFlash<1024>;
using Profile = config::Micro;

struct Desk : test::Desk<Profile> {
  explicit Desk(Flash& flash) : keeper(pipeline(), flash) { keeper.restore(); }
  Keeper<Profile, Flash> keeper;
};

std::string all_of(loop::Memory<Profile>& memory) {
  std::string text = test::line_of(memory.calibration.intrinsics);
  for (const auto& signature : memory.signatures) text += test::line_of(signature);
  for (std::size_t i = 0; i < config::kKeys; ++i)
    text += memory.settings.text(static_cast<config::Key>(i)).view(), text += ' ';
  return text;
}

TEST(Keeper, RestoresSettingsCalibrationAndSignatures) {
  Flash flash;
  Desk desk(flash);
  const std::string fresh = all_of(desk.memory());
  sensor::CameraIntrinsics camera = test::level_pixy2();
  camera.mount.x = base::Metres::nearest(0.0712);
  camera.mount.pitch.reset();
  desk.pipeline().set_camera(camera);
  ASSERT_TRUE(desk.pipeline().set_signature({2, {1, 2, 3}, "dark, almost"}));
  ASSERT_FALSE(desk.pipeline().set("alert.stop", "0.4"));
  ASSERT_FALSE(desk.pipeline().set("correct.pose", "on"));
  EXPECT_TRUE(desk.keeper.keep());
  const std::string told = all_of(desk.memory());
  EXPECT_NE(told, fresh);

  Desk again(flash);
  EXPECT_EQ(all_of(again.memory()), told);
}

TEST(Keeper, WritesOnlyWhatHasChanged) {
  Flash flash;
  Desk desk(flash);
  EXPECT_TRUE(desk.keeper.keep());
  EXPECT_EQ(flash.page(0)[0], 0xFF);  // nothing was told: nothing is written
  for (int i = 0; i < 300; ++i) {
    ASSERT_FALSE(desk.pipeline().set("alert.warn", i % 2 == 0 ? "0.60" : "0.70"));
    ASSERT_TRUE(desk.keeper.keep()) << i;
    ASSERT_TRUE(desk.keeper.keep()) << i;
  }
  // 40 bytes a change, some 20 changes a page.
  EXPECT_GT(flash.erasures(), 5U);
  EXPECT_LT(flash.erasures(), 30U);
  EXPECT_EQ(Desk(flash).memory().settings.text(config::Key::kAlertWarn).view(), "0.70");
}

TEST(Keeper, CalibrationOfACameraOfAnotherSizeIsPassedOver) {
  Flash flash;
  Desk desk(flash);
  sensor::CameraIntrinsics camera = test::level_pixy2();
  camera.width = 160;
  desk.pipeline().set_camera(camera);
  EXPECT_TRUE(desk.keeper.keep());
  EXPECT_EQ(Desk(flash).memory().calibration.intrinsics.width, 316);
}

TEST(Keeper, SaysOnceThatThePartRefuses) {
  Flash flash;
  Desk desk(flash);
  flash.cut_after(0);
  ASSERT_FALSE(desk.pipeline().set("alert.stop", "0.4"));
  EXPECT_FALSE(desk.keeper.keep());
  EXPECT_TRUE(desk.keeper.keep());
}

}  // namespace
}  // namespace fencepost::image
