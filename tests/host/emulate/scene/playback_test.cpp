// Time in a playback: when it begins, what each moment shows, when it ends. Stepped; nothing here waits.
#include "host/emulate/scene/playback.hpp"

#include <gtest/gtest.h>

#include "drivers/create/create.hpp"
#include "drivers/pixy2/camera.hpp"
#include "tests/drivers/hex.hpp"
#include "tests/host/emulate/scene/rig.hpp"

namespace fencepost::emulate {
namespace {

using test::hex;

PlaybackSettings after(std::int64_t ms) {
  PlaybackSettings settings;
  settings.delay = base::milliseconds(ms);
  return settings;
}

TEST(Playback, BeginsWhenEveryConnectedDeviceIsInUse) {
  Rig rig(moving_box(316, 208, 5));
  EndpointLink pixy2 = rig.add("pixy2,baud=0");
  EndpointLink create = rig.add("create2");
  for (int i = 0; i < 3'000; ++i) rig.step();
  EXPECT_FALSE(rig.playback.begun()) << "nobody has asked";
  ASSERT_TRUE(create.write(hex("80 94 02 2B 2C")));
  for (int i = 0; i < 1'000; ++i) rig.step();
  EXPECT_FALSE(rig.playback.begun()) << "the camera is connected and not in use";
  ASSERT_TRUE(pixy2.write(hex("AE C1 20 02 FF FF")));
  for (int i = 0; i < 98; ++i) rig.step();
  EXPECT_FALSE(rig.playback.begun()) << "another device may follow";
  for (int i = 0; i < 4; ++i) rig.step();
  EXPECT_TRUE(rig.playback.begun());
}

TEST(Playback, BeginsWithoutWhoeverIsNotConnected) {
  Rig rig(moving_box(316, 208, 5));
  rig.add("pixy2");
  rig.playback.endpoint(0).connect(false, rig.clock.now());
  EndpointLink create = rig.add("create2");
  ASSERT_TRUE(create.write(hex("80 94 02 2B 2C")));
  for (int i = 0; i < 150; ++i) rig.step();
  EXPECT_TRUE(rig.playback.begun());
}

TEST(Playback, BeginsAtTheLatestAfterTheDelay) {
  Rig rig(moving_box(316, 208, 5), after(500));
  rig.add("pixy2");
  for (int i = 0; i < 499; ++i) rig.step();
  EXPECT_FALSE(rig.playback.begun());
  rig.step();
  EXPECT_EQ(rig.playback.begun(), base::Time{5'000});
}

// Five frames until 0.5 s, poses until 0.5 s: over at 1.5 s.
TEST(Playback, IsOverASecondAfterTheLastRecord) {
  Rig rig(moving_box(316, 208, 5), after(0));
  rig.add("pixy2");
  while (!rig.playback.over(rig.clock.now()) && rig.clock.now() < base::Time{100'000}) rig.step();
  EXPECT_NEAR(rig.since_begin(), 1.5, 0.002);
  EXPECT_EQ(rig.playback.endpoint(0).counts().frames, 5U);
}

TEST(Playback, EndsAfterTheSecondsAndAtItsSpeed) {
  PlaybackSettings settings = after(0);
  settings.seconds = base::milliseconds(250);
  settings.speed = 2;
  Rig rig(moving_box(316, 208, 10), settings);
  rig.add("pixy2");
  while (!rig.playback.over(rig.clock.now()) && rig.clock.now() < base::Time{100'000}) rig.step();
  EXPECT_NEAR(rig.since_begin(), 0.25, 0.002);
  EXPECT_EQ(rig.playback.endpoint(0).counts().frames, 5U) << "at 0.1 to 0.5 s of the feed";
}

// A round is 0.5 s and the pause of 20 ms. In 2 s there are three whole ones and the frames at 0.1 to 0.4 s of the
// fourth.
TEST(Playback, LoopsAndTheWheelsGoOn) {
  PlaybackSettings settings = after(0);
  settings.loop = true;
  Rig rig(moving_box(316, 208, 5), settings);
  rig.add("pixy2");
  EndpointLink create = rig.add("create2");
  create::Create<EndpointLink> driver(create, create::Config{});
  sensor::OdometrySample last;
  for (int i = 0; i < 2'000; ++i) {
    rig.step();
    if (const auto sample = driver.poll(rig.clock.now())) last = *sample;
  }
  EXPECT_FALSE(rig.playback.over(rig.clock.now()));
  EXPECT_EQ(rig.playback.rounds(), 3U);
  EXPECT_EQ(rig.playback.endpoint(0).counts().frames, 19U);
  EXPECT_NEAR(last.x.to_double(), 0.2 * (3 * 0.5 + 0.44), 0.01);
  EXPECT_EQ(driver.session().counts().impossible, 0U) << "no jump back, which the driver would take for a restart";
}

// A device that is looked at seldom has still done everything at its own time.
TEST(Playback, IsTheSameInLongSteps) {
  const auto bytes_of = [](base::Duration step) {
    fake::SteppedClock clock;
    Playback playback(moving_box(316, 208, 5), after(0), clock.now());
    Endpoint& endpoint = playback.add({"create2", emulated_device("create2,baud=0"), {}, 1, {}});
    endpoint.connect(true, clock.now());
    playback.advance(clock.now());
    playback.hear(0, hex("80 94 02 2B 2C"), clock.now());
    while (clock.now() < base::Time{6'000}) {
      clock.advance(step);
      playback.advance(clock.now());
    }
    return endpoint.to_host(clock.now());
  };
  const Bytes fine = bytes_of(base::Duration{1});
  EXPECT_EQ(fine.size(), 40 * 9U) << "a frame each 15 ms";
  EXPECT_EQ(fine, bytes_of(base::milliseconds(200)));
  EXPECT_EQ(fine, bytes_of(base::milliseconds(600)));
}

// 20 s, unplugged at 3 s for 1 s, so again 3 s later: 3, 7, 11, 15, 19. Switched off at 6, 12 and 18 s.
TEST(Playback, RebootsAndUnplugsInTime) {
  FaultSettings faults;
  faults.reboot = base::milliseconds(6'000);
  faults.unplug = base::milliseconds(3'000);
  faults.unplug_time = base::milliseconds(1'000);
  Rig rig(moving_box(316, 208, 200), after(0));
  EndpointLink link = rig.add("pixy2,baud=0", faults);
  pixy2::Camera<EndpointLink> camera(link);
  std::size_t unplugged = 0;
  std::size_t frames = 0;
  for (int i = 0; i < 20'000; ++i) {
    rig.step();
    if (camera.poll(rig.clock.now())) ++frames;
    const bool gone = rig.playback.endpoint(0).unplugged();
    unplugged += gone ? 1U : 0U;
    if (gone) {
      EXPECT_EQ(camera.link(), sensor::LinkState::kAbsent);
    }
  }
  EXPECT_EQ(rig.playback.endpoint(0).faults().reboots, 3U);
  EXPECT_EQ(rig.playback.endpoint(0).faults().unplugs, 5U);
  EXPECT_NEAR(static_cast<double>(unplugged), 5'000, 5);
  EXPECT_GT(frames, 80U) << "it comes back each time";
  EXPECT_LT(frames, 150U);
}

std::size_t frames_through(const FaultSettings& faults, std::uint64_t seed, FaultCounts& counts) {
  Rig rig(moving_box(316, 208, 100));
  EndpointLink link = rig.add("pixy2,baud=0", faults, seed);
  pixy2::Camera<EndpointLink> camera(link);
  std::size_t frames = 0;
  while (!rig.playback.over(rig.clock.now()) && rig.clock.now() < base::Time{600'000}) {
    rig.step();
    if (camera.poll(rig.clock.now())) ++frames;
  }
  counts = rig.playback.endpoint(0).faults();
  return frames;
}

TEST(Playback, HasTheSameFaultsForTheSameSeed) {
  FaultSettings faults;
  faults.drop = faults.corrupt = 0.005;
  FaultCounts first;
  FaultCounts second;
  FaultCounts other;
  const std::size_t frames = frames_through(faults, 3, first);
  EXPECT_EQ(frames, frames_through(faults, 3, second));
  EXPECT_EQ(first.bytes, second.bytes);
  EXPECT_EQ(first.dropped, second.dropped);
  EXPECT_EQ(first.corrupted, second.corrupted);
  frames_through(faults, 4, other);
  EXPECT_NE(first.bytes, other.bytes);
  EXPECT_GT(first.dropped, 0U);
  EXPECT_LE(frames, 100U);
}

TEST(Playback, TracesCommandsAndReplies) {
  std::vector<std::string> lines;
  Playback playback(moving_box(316, 208, 5), after(0), base::Time{});
  playback.add({"pixy2", emulated_device("pixy2"), {}, 1, [&](const std::string& line) { lines.push_back(line); }});
  playback.endpoint(0).connect(true, base::Time{});
  playback.advance(base::Time{20'000});
  playback.hear(0, hex("AE C1 0E 00"), base::Time{20'000});
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0], "   2.0000 pixy2 < AE C1 0E 00  getVersion");
  EXPECT_EQ(lines[1].rfind("   2.0000 pixy2 > AF C1 0F 10", 0), 0U) << lines[1];
}

}  // namespace
}  // namespace fencepost::emulate
