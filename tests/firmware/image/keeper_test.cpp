// A robot's configuration survives a reset.
#include "firmware/image/keeper.hpp"

#include <gtest/gtest.h>

#include <utility>

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
  EXPECT_EQ(flash.page(0)[0], 0xFF);  // nothing was configured: nothing is written
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

constexpr config::DeviceOffer kOffer = {
    {0b11111, 0b1111, true, 0, false, config::Devices(config::CameraId::kPixy2, config::OdometryId::kConsole)}, {}};

struct OfferedDesk : test::Desk<Profile> {
  OfferedDesk(Flash& flash, const config::DeviceOffer& offer) : keeper(pipeline(), flash) {
    pipeline().offer(offer);
    keeper.restore();
  }
  Keeper<Profile, Flash> keeper;
};

TEST(Keeper, RestoresDevicesAndTheCalibrationThatCameAfterThem) {
  Flash flash;
  OfferedDesk desk(flash, kOffer);
  ASSERT_TRUE(desk.pipeline().set_device("camera", "pixy2.1_i2c").done());
  ASSERT_TRUE(desk.pipeline().set_device("odometry", "create2").done());
  ASSERT_TRUE(desk.pipeline().set_device("drive", "100").done());
  sensor::CameraIntrinsics camera = desk.memory().calibration.intrinsics;
  EXPECT_EQ(camera.fx.raw, 18'830);
  camera.mount.x = base::Metres::nearest(0.0712);
  camera.fx.raw = 18'000;
  desk.pipeline().set_camera(camera);
  EXPECT_TRUE(desk.keeper.keep());

  OfferedDesk again(flash, kOffer);
  EXPECT_EQ(again.memory().devices, desk.memory().devices);
  EXPECT_EQ(again.memory().calibration.intrinsics, camera);
  ASSERT_TRUE(again.pipeline().set_device("camera", "console").done());
  EXPECT_TRUE(again.keeper.keep());
  EXPECT_FALSE(OfferedDesk(flash, kOffer).memory().calibration.known);
}

// Each was possible when it was kept; of another image, not together, or not at all.
TEST(Keeper, DevicesThatCannotBeHadAreThoseOfAFreshImage) {
  Flash flash;
  config::DeviceOffer two_lines = kOffer;
  two_lines.limits.one_line = false;
  OfferedDesk desk(flash, two_lines);
  ASSERT_TRUE(desk.pipeline().set_device("camera", "pixy2.1").done());
  ASSERT_TRUE(desk.pipeline().set_device("odometry", "create2").done());
  EXPECT_TRUE(desk.keeper.keep());

  OfferedDesk again(flash, kOffer);
  EXPECT_EQ(again.memory().devices, kOffer.limits.initial);
  EXPECT_EQ(again.memory().calibration.intrinsics.model.view(), "pixy2");
}

// A camera, its lens and where it is mounted, settings and a colour, all between two looks. A robot with only some of
// them has a configuration that nobody gave it.
TEST(Keeper, PowerCutAtAnyWordLeavesAllThatWasToldOrNothing) {
  const auto all = [](OfferedDesk& desk) {
    std::string text = all_of(desk.memory());
    for (std::size_t i = 0; i < config::kDeviceKeys; ++i)
      text += desk.memory().devices.text(static_cast<config::DeviceKey>(i)).view(), text += ' ';
    return text;
  };
  std::size_t cuts = 0;
  std::size_t kept = 0;
  // In an empty page, behind others, and where the page is full; the word that was being written torn, and not begun.
  for (const auto& [earlier, torn] : {std::pair(0, true), {0, false}, {1, true}, {1, false}, {14, true}, {14, false}}) {
    bool cut = true;
    for (std::size_t words = 0; cut; ++words) {
      Flash flash;
      OfferedDesk desk(flash, kOffer);
      for (int i = 0; i < earlier; ++i) {
        ASSERT_FALSE(desk.pipeline().set("alert.warn", i % 2 == 0 ? "0.60" : "0.70"));
        ASSERT_TRUE(desk.keeper.keep());
      }
      const std::string before = all(desk);
      ASSERT_TRUE(desk.pipeline().set_device("camera", "pixy2.1_i2c").done());
      sensor::CameraIntrinsics camera = desk.memory().calibration.intrinsics;
      camera.mount.x = base::Metres::nearest(0.0712);
      camera.fx.raw = 18'000;
      desk.pipeline().set_camera(camera);
      ASSERT_TRUE(desk.pipeline().set_signature({2, {1, 2, 3}, "dark, almost"}));
      ASSERT_FALSE(desk.pipeline().set("robot.width", "0.31"));
      ASSERT_FALSE(desk.pipeline().set("robot.front", "0.22"));
      const std::string after = all(desk);
      flash.cut_after(words, torn);
      static_cast<void>(desk.keeper.keep());
      cut = flash.dead();
      flash.power_on();
      OfferedDesk again(flash, kOffer);
      const std::string restored = all(again);
      ASSERT_TRUE(restored == before || restored == after) << "cut after " << words << " words\n" << restored;
      cuts += cut ? 1U : 0U;
      kept += restored == after ? 1U : 0U;
    }
  }
  EXPECT_GT(cuts, 400U);
  EXPECT_EQ(kept, 6U);  // where the power was not cut
}

TEST(Keeper, SaysOnceThatThePartRefuses) {
  Flash flash;
  Desk desk(flash);
  flash.cut_after(0);
  ASSERT_FALSE(desk.pipeline().set("alert.stop", "0.4"));
  EXPECT_FALSE(desk.keeper.keep());
  EXPECT_TRUE(desk.keeper.keep());
}

// Lines of an image that kept more than this one, or of another program.
TEST(Keeper, WhatIsNoInputOfAStartIsPassedOver) {
  Flash flash;
  config::SettingsStore store(flash);
  const auto without_end = [](std::string line) { return line.substr(0, line.find('\r')); };
  ASSERT_TRUE(store.rewrite([&](auto& put) {
    put(without_end(test::line_of(sensor::OdometrySample{base::Time{5}, {}, {}, {}})));
    put("no record at all");
    put(without_end(test::line_of(record::Setting{std::string_view("alert.stop"), std::string_view("0.4")})));
  }));
  Desk desk(flash);
  EXPECT_EQ(desk.memory().settings.text(config::Key::kAlertStop).view(), "0.40");
  EXPECT_TRUE(desk.memory().poses.empty());
  EXPECT_FALSE(desk.pipeline().stream_time()) << "the stream has not begun";
}

}  // namespace
}  // namespace fencepost::image
