// The conversation with an emulated XBC, and an hour of it on a bad line.
#include "drivers/xbc/session.hpp"

#include <gtest/gtest.h>

#include <optional>

#include "drivers/xbc/xbc.hpp"
#include "hal/fake/scripted_link.hpp"
#include "hal/fake/stepped_clock.hpp"
#include "host/emulate/xbc.hpp"
#include "tests/drivers/wire.hpp"

namespace fencepost::xbc {
namespace {

using sensor::LinkState;

const std::vector<emulate::XbcBlob> kScene = {{0, 0, 178, 146, 600, 160, 131, 196, 160, 0},
                                              {1, 0, 40, 200, 45, 37, 195, 43, 204, -785}};

/// 15 frames a second, in steps of 5 ms.
struct Rig {
  std::optional<sensor::BlobFrame> step() {
    clock.advance(base::milliseconds(5));
    ++steps;
    const std::string asked = wire.to_device();
    if (powered) wire.from_device(device.feed(asked));
    if (powered && camera_on && steps % 13 == 0) {
      ++sent;
      const std::uint32_t before = wire.damaged_bytes();
      wire.from_device(device.frame(scene));
      good += wire.damaged_bytes() == before ? 1U : 0U;
    }
    const auto frame = driver.poll(clock.now());
    if (!frame) return std::nullopt;
    ++received;
    EXPECT_LT(last_t, frame->t);
    last_t = frame->t;
    const bool right = frame->blobs.size() == 2 && frame->blobs[0].x1 == 160 && frame->blobs[0].y2 == 160 &&
                       frame->blobs[1].x1 == 37 && frame->blobs[1].x2 == 43 && frame->blobs[0].pixels == 600;
    wrong += right ? 0U : 1U;
    return *frame;
  }
  void run(std::int64_t ms) {
    for (std::int64_t i = 0; i < ms / 5; ++i) (void)step();
  }

  fake::SteppedClock clock;
  serial::Wire wire{11};
  emulate::XbcDevice device;
  Xbc<serial::Wire> driver{wire, Config{}};
  std::vector<emulate::XbcBlob> scene = kScene;
  bool powered = true;
  bool camera_on = true;
  std::int64_t steps = 0;
  base::Time last_t{-1};
  std::uint32_t sent = 0;
  std::uint32_t good = 0;  ///< sent whole
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

TEST(XbcSession, LinkStates) {
  Rig rig;
  rig.camera_on = false;
  rig.run(500);
  EXPECT_EQ(rig.driver.link(), LinkState::kUnready) << "it answers and sends no frames";
  rig.camera_on = true;
  rig.run(500);
  EXPECT_EQ(rig.driver.link(), LinkState::kOk);
  rig.powered = false;
  rig.run(1'200);
  EXPECT_EQ(rig.driver.link(), LinkState::kSilent);
  rig.powered = true;
  (void)rig.device.power_up();
  rig.run(1'200);
  EXPECT_EQ(rig.driver.link(), LinkState::kOk);
  rig.wire.unplug();
  rig.run(100);
  EXPECT_EQ(rig.driver.link(), LinkState::kAbsent);
  rig.wire.replug();
  rig.run(500);
  EXPECT_EQ(rig.driver.link(), LinkState::kOk);
  EXPECT_EQ(rig.driver.session().version(), 1) << "asked again";
}

TEST(XbcSession, AsksAndIsNotAnswered) {
  fake::ScriptedLink<256> link({});
  Xbc<fake::ScriptedLink<256>> driver(link, Config{});
  for (std::int64_t ms = 0; ms < 10'000; ms += 10) EXPECT_FALSE(driver.poll({ms * 10}).ok());
  EXPECT_EQ(driver.link(), LinkState::kSilent);
  const std::string asked(link.written().begin(), link.written().end());
  EXPECT_EQ(asked, "?\n?\n?\n?\n?\n?\n?\n?\n?\n?\n");
}

TEST(XbcSession, AnotherVersionIsNotReady) {
  Session session{Config{}};
  const auto feed = [&](std::string_view bytes) {
    bool any = false;
    for (const char byte : bytes) any = session.take(static_cast<std::uint8_t>(byte), {10}) || any;
    return any;
  };
  const std::string_view frame = "$F 1234 0*72\n$E 1234*61\n";
  EXPECT_TRUE(feed(frame)) << "the version has not been told yet";
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

TEST(HostileXbc, AnHourOfEverything) {
  Rig rig;
  rig.wire.damage_one_byte_in(100);
  for (int minute = 0; minute < 60; ++minute) {
    switch (minute % 6) {
      case 1: rig.wire.stall(true); break;
      case 2: rig.wire.unplug(); break;
      case 3: rig.powered = false; break;
      default: break;
    }
    rig.run(300 + static_cast<std::int64_t>(rig.wire.random()() % 5'000));
    rig.wire.stall(false);
    rig.wire.replug();
    rig.powered = true;
    const std::uint32_t before = rig.received;
    rig.run(60'000);
    EXPECT_GT(rig.received, before + 100) << "minute " << minute << ": did not come back";
  }
  RecordProperty("frames", static_cast<int>(rig.received));
  RecordProperty("undetected", static_cast<int>(rig.wrong));
  // Two damaged bytes in one line that cancel out are possible, and rare.
  EXPECT_LT(rig.wrong, rig.received / 1'000);
}

// Damage alone: what was sent whole arrives, but for at most one frame a damaged byte (a lost line end takes the next
// line with it, were it not for its `$`).
TEST(HostileXbc, DamageCostsTheDamagedFrameOnly) {
  Rig rig;
  rig.run(1'000);
  rig.wire.damage_one_byte_in(1'000);
  rig.run(3'600'000);
  EXPECT_GT(rig.wire.damaged_bytes(), 5'000U);
  EXPECT_GE(rig.received + 1, rig.good);
  EXPECT_LE(rig.sent - rig.received, rig.wire.damaged_bytes());
  EXPECT_EQ(rig.wrong, 0U);
}

}  // namespace
}  // namespace fencepost::xbc
