// The session with an emulated JeVois.
#include "drivers/jevois/session.hpp"

#include <gtest/gtest.h>

#include "hal/fake/scripted_link.hpp"
#include "tests/drivers/jevois/rig.hpp"
#include "tests/drivers/says.hpp"

namespace fencepost::jevois {
namespace {

using sensor::LinkState;

struct Rig : test::Bench<test::JeVoisRig> {
  Rig() { scene = {blob_of(500), blob_of(900)}; }
};

TEST(JevoisSession, SaysHowToWriteUntilFramesCome) {
  fake::ScriptedLink<1'024> link({});
  JeVois<fake::ScriptedLink<1'024>> driver(link, Config{});
  const std::string once =
      "setpar serout All\nsetpar serstyle Normal\nsetpar serprec 1\nsetpar serstamp Frame\nsetpar sermark Both\n"
      "streamon\n";
  for (std::int64_t ms = 0; ms < 1'500; ms += 10) EXPECT_FALSE(driver.poll({ms * 10}).ok());
  EXPECT_EQ(std::string(link.written().begin(), link.written().end()), once + once + once);
  EXPECT_EQ(driver.link(), LinkState::kSilent);
}

// Another module was loaded: style and marks are as delivered again.
TEST(JevoisSession, AnotherModuleIsToldAnew) {
  Rig rig;
  rig.run(4'000);
  for (const char c : std::string("setpar sermark None\nsetpar serstyle Terse\n")) {
    (void)rig.device.take(static_cast<std::uint8_t>(c), rig.clock.now());
  }
  rig.run(100);
  EXPECT_FALSE(rig.run(1'000).empty());
  EXPECT_EQ(rig.driver.link(), LinkState::kOk);
}

TEST(JevoisSession, NominalCalibration) {
  sensor::CameraMount mount;
  mount.z = {1'200};
  const sensor::CameraIntrinsics camera = nominal_intrinsics(mount);
  EXPECT_EQ(camera.model.view(), "jevois");
  EXPECT_EQ(camera.width, 320);
  EXPECT_EQ(camera.height, 240);
  EXPECT_EQ(camera.fx.raw, 27'713);
  EXPECT_EQ(camera.fy.raw, 27'713);
  EXPECT_EQ(camera.cx.raw, 15'950);
  EXPECT_EQ(camera.cy.raw, 11'950);
  EXPECT_EQ(camera.mount, mount);
  EXPECT_EQ(camera.latency, base::milliseconds(67));
}

TEST(JevoisSession, WaitsHalfASecondEachTime) {
  Session session{Config{}};
  const auto hear = [&](std::string_view text, std::int64_t t) {
    for (const char c : text) (void)session.take(static_cast<std::uint8_t>(c), {t});
  };
  const auto said = [&](std::int64_t t) { return test::says(session, t); };
  EXPECT_TRUE(said(0));
  EXPECT_FALSE(said(4'999));
  hear("MARK START\nMARK STOP\n", 4'999);
  EXPECT_TRUE(said(5'000)) << "its frames are not as configured";
  EXPECT_EQ(session.link(), LinkState::kEmpty);
  hear("1 MARK START\n1 N2 a 0.0 0.0 10.0 10.0\n1 MARK STOP\n", 6'000);
  EXPECT_FALSE(said(10'000)) << "they are";
  EXPECT_FALSE(said(11'000));
  EXPECT_EQ(session.link(), LinkState::kOk);
  hear("OK\n", 11'000);
  EXPECT_TRUE(said(11'001)) << "no frame for more than half a second";
  EXPECT_EQ(session.link(), LinkState::kUnready);
  EXPECT_FALSE(said(16'000));
  EXPECT_EQ(session.link(), LinkState::kUnready);
  EXPECT_TRUE(said(16'001));
  EXPECT_EQ(session.link(), LinkState::kSilent);
}

}  // namespace
}  // namespace fencepost::jevois
