// The session with an emulated XBC, and an hour of it with damaged bytes.
#include "drivers/xbc/session.hpp"

#include <gtest/gtest.h>

#include "tests/drivers/bench/xbc_rig.hpp"
#include "tests/drivers/hex.hpp"
#include "tests/drivers/says.hpp"

namespace fencepost::xbc {
namespace {

using sensor::LinkState;

const std::vector<emulate::XbcBlob> kScene = {{0, 0, 178, 146, 600, 160, 131, 196, 160, 0},
                                              {1, 0, 40, 200, 45, 37, 195, 43, 204, -785}};

/// Counts the frames that are not of the scene.
struct Rig : test::Bench<test::XbcRig> {
  Rig() { scene = kScene; }
  void run(std::int64_t ms) {
    for (const sensor::BlobFrame& frame : test::Bench<test::XbcRig>::run(ms)) {
      ++received;
      const bool right = frame.blobs.size() == 2 && frame.blobs[0].x1 == 160 && frame.blobs[0].y2 == 160 &&
                         frame.blobs[1].x1 == 37 && frame.blobs[1].x2 == 43 && frame.blobs[0].pixels == 600;
      wrong += right ? 0U : 1U;
    }
  }
  std::uint32_t received = 0;
  std::uint32_t wrong = 0;
};

TEST(XbcSession, FramesAndVersion) {
  Rig rig;
  EXPECT_EQ(rig.driver.link(), LinkState::kSilent);
  rig.run(2'000);
  EXPECT_EQ(rig.driver.link(), LinkState::kOk);
  EXPECT_EQ(rig.driver.session().version(), 1);
  EXPECT_EQ(rig.received, rig.sent);
  EXPECT_EQ(rig.wrong, 0U);
  rig.scene.clear();
  rig.run(200);
  EXPECT_EQ(rig.driver.link(), LinkState::kEmpty);
}

TEST(XbcSession, AsksOnceHoweverLongTheLineIsBlocked) {
  Session session{Config{}};
  const auto waiting = [&] {
    return std::string(session.outbox().waiting().begin(), session.outbox().waiting().end());
  };
  for (std::int64_t ms = 0; ms <= 10'000; ms += 500) session.step({10 * ms});
  EXPECT_EQ(waiting(), "?\n");
  session.link_lost();
  EXPECT_EQ(waiting(), "");
  session.step({100'001});
  EXPECT_EQ(waiting(), "?\n") << "at once";
}

TEST(XbcSession, WaitsASecondEachTime) {
  Session session{Config{}};
  const auto asks = [&](std::int64_t t) { return test::says(session, t); };
  EXPECT_TRUE(asks(0));
  EXPECT_FALSE(asks(9'999));
  EXPECT_TRUE(asks(10'000));
  for (const char c : std::string("$V XBCL 1*72\n$F 1 0*47\n$E 1*54\n")) (void)session.take(test::octet(c), {10'000});
  EXPECT_EQ(session.version(), 1);
  EXPECT_EQ(session.link(), LinkState::kEmpty);
  EXPECT_FALSE(asks(20'000)) << "it has answered";
  EXPECT_EQ(session.link(), LinkState::kEmpty);
  EXPECT_TRUE(asks(20'001)) << "and is not heard any more";
  EXPECT_EQ(session.link(), LinkState::kSilent);
  EXPECT_EQ(session.version(), 0);
}

TEST(XbcSession, NominalCalibration) {
  const sensor::CameraIntrinsics camera = nominal_intrinsics({});
  EXPECT_EQ(camera.width, 356);
  EXPECT_EQ(camera.height, 291);
  EXPECT_EQ(camera.fx.raw, 42'973);
  EXPECT_EQ(camera.fy.raw, 42'973);
  EXPECT_EQ(camera.cx.raw, 17'750);
  EXPECT_EQ(camera.cy.raw, 14'500);
  EXPECT_EQ(camera.latency, base::milliseconds(133));
}

TEST(XbcSession, LinkStates) {
  Rig rig;
  rig.exposing = false;
  rig.run(500);
  EXPECT_EQ(rig.driver.link(), LinkState::kUnready) << "it answers and sends no frames";
  rig.exposing = true;
  rig.run(500);
  EXPECT_EQ(rig.driver.link(), LinkState::kOk);
  rig.link.power(false);
  rig.run(1'200);
  EXPECT_EQ(rig.driver.link(), LinkState::kSilent);
  rig.link.power(true);
  (void)rig.device.power_up();
  rig.run(1'200);
  EXPECT_EQ(rig.driver.link(), LinkState::kOk);
  rig.link.unplug();
  rig.run(100);
  EXPECT_EQ(rig.driver.link(), LinkState::kAbsent);
  rig.link.replug();
  rig.run(500);
  EXPECT_EQ(rig.driver.link(), LinkState::kOk);
  EXPECT_EQ(rig.driver.session().version(), 1) << "asked again";
}

TEST(XbcSession, AnotherVersionIsNotReady) {
  Session session{Config{}};
  const auto feed = [&](std::string_view bytes) {
    bool any = false;
    for (const char byte : bytes) any = session.take(static_cast<std::uint8_t>(byte), {10}) || any;
    return any;
  };
  const std::string_view frame = "$F 1234 0*72\n$E 1234*61\n";
  EXPECT_TRUE(feed(frame)) << "the version is not known yet";
  EXPECT_FALSE(feed("$V XBCL 2*71\n"));
  EXPECT_EQ(session.version(), 2);
  EXPECT_FALSE(feed(frame));
  EXPECT_EQ(session.link(), LinkState::kUnready);
  session.step({20'000});
  EXPECT_EQ(session.link(), LinkState::kSilent);
}

TEST(XbcSession, SignaturesAreTheUsers) {
  Session session{Config{{7, 8, 9}}};
  for (const char byte : std::string_view("$F 1234 1*73\n$B 1 0 40 200 45 64 37 195 43 204 -785*49\n$E 1234*61\n")) {
    (void)session.take(static_cast<std::uint8_t>(byte), {10});
  }
  ASSERT_EQ(session.sample().blobs.size(), 1U);
  EXPECT_EQ(session.sample().blobs[0].signature, 8);
}

}  // namespace
}  // namespace fencepost::xbc
