// The pump, against scripted bytes and against the emulated camera.
#include "drivers/pixy2/camera.hpp"

#include <gtest/gtest.h>

#include <random>

#include "hal/fake/scripted_link.hpp"
#include "tests/drivers/bench/pixy2_rig.hpp"
#include "tests/drivers/hex.hpp"

namespace fencepost::pixy2 {
namespace {

using sensor::LinkState;
using test::bytes_of;
using test::hex;
using Bench = test::Bench<test::Pixy2Rig>;
using Link = test::Pixy2Rig::Link;

static_assert(sensor::BlobCamera<Camera<Link>>);

const sensor::Blob kRed{1, 138, 89, 177, 119, {1575}, {1040}, 0, {}};
const sensor::Blob kSmall{2, 44, 55, 55, 65, {495}, {600}, 0, {}};

TEST(Pixy2Camera, GreetsAndAsksInOrder) {
  const auto version = hex("AF C1 0F 10 17 03 00 22 03 00 14 00 67 65 6E 65 72 61 6C 00 00 00");
  const auto runs = hex("AF C1 01 04 01 00 01 00 00 00");
  const auto resolution = hex("AF C1 0D 04 0D 01 3C 01 D0 00");
  const auto block = hex("AF C1 21 0E 6D 01 01 00 9E 00 68 00 28 00 1E 00 00 00 07 19");
  const base::Error none = base::Error::kNotReady;
  const std::array<fake::LinkStep, 8> script = {
      {{{}, none}, {version, {}}, {{}, none}, {runs, {}}, {{}, none}, {resolution, {}}, {{}, none}, {block, {}}}};
  fake::ScriptedLink<128> link(script);
  Camera<fake::ScriptedLink<128>> camera(link, {.signatures = 0xFF});
  std::optional<sensor::BlobFrame> seen;
  for (int ms = 1; ms <= 10 && !seen; ++ms) {
    if (const auto frame = camera.poll(base::Time{ms * 10})) seen = *frame;
  }
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->blobs.size(), 1U);
  EXPECT_EQ(seen->blobs[0], kRed);
  EXPECT_EQ(camera.session().version()->build, 20);
  std::vector<std::uint8_t> expected = hex("AF C1 0E 00 00 00");
  for (const auto& part : {bytes_of(request_program()), hex("AF C1 0C 01 00 00 00"), hex("AF C1 20 02 FE 01 FF FF")}) {
    expected.insert(expected.end(), part.begin(), part.end());
  }
  EXPECT_EQ(bytes_of(link.written()), expected);
}

// What each error of the camera's means to a session that asks for blocks.
TEST(Pixy2Camera, ErrorsThatPassRestartNothing) {
  const auto restarts = [](int error, std::uint8_t signatures) {
    Session session({.signatures = signatures});
    base::Time now{0};
    const auto answer = [&](const char* bytes) {
      now = now + base::milliseconds(200);
      EXPECT_TRUE(session.due(now));
      session.take(packet_of(hex(bytes)), now, now);
    };
    answer("AF C1 0F 10 17 03 00 22 03 00 14 00 67 65 6E 65 72 61 6C 00 00 00");
    answer("AF C1 01 04 01 00 01 00 00 00");
    answer("AF C1 0D 04 0D 01 3C 01 D0 00");
    EXPECT_EQ(session.link(), LinkState::kUnready);
    now = now + base::milliseconds(200);
    EXPECT_TRUE(session.due(now));
    const std::uint8_t code = static_cast<std::uint8_t>(error);
    session.take({Type::kError, std::span(&code, 1)}, now, now);
    return session.counters().restarts;
  };
  for (int error = -8; error < 0; ++error) {
    const auto meant = static_cast<DeviceError>(error);
    const bool passes =
        meant == DeviceError::kBusy || meant == DeviceError::kButton || meant == DeviceError::kProgramChanging;
    EXPECT_EQ(restarts(error, 0xFF), passes ? 0U : 1U) << error;
    EXPECT_EQ(restarts(error, 0), 0U) << error << ": nothing is asked for that a restart would mend";
  }
}

// Firmware that cannot change programs has only one: it goes on with the resolution.
TEST(Pixy2Camera, FirmwareWithOneProgramIsTakenAsItIs) {
  Session session({});
  base::Time now{0};
  const auto answer = [&](const char* bytes) {
    now = now + base::milliseconds(200);
    const auto asked = session.due(now);
    EXPECT_TRUE(asked);
    session.take(packet_of(hex(bytes)), now, now);
    return asked ? bytes_of(*asked) : std::vector<std::uint8_t>{};
  };
  EXPECT_EQ(answer("AF C1 0F 10 17 03 00 22 03 00 14 00 67 65 6E 65 72 61 6C 00 00 00"), bytes_of(request_version()));
  EXPECT_EQ(answer("AF C1 03 01 FC 00 FC"), bytes_of(request_program()));
  EXPECT_EQ(answer("AF C1 0D 04 0D 01 3C 01 D0 00"), bytes_of(request_resolution()));
  EXPECT_EQ(session.counters().restarts, 0U);
  EXPECT_EQ(session.counters().malformed, 0U);
  answer("AF C1 0D 04 0D 01 3C 01 D0 00");
  EXPECT_EQ(session.counters().malformed, 1U) << "no blocks";
}

// Half an answer, the plug out and in, and then the other half.
TEST(Pixy2Camera, ALostLinkLeavesNothingOfAnAnswer) {
  const auto version = hex("AF C1 0F 10 17 03 00 22 03 00 14 00 67 65 6E 65 72 61 6C 00 00 00");
  const std::vector<std::uint8_t> first(version.begin(), version.begin() + 10);
  const std::vector<std::uint8_t> second(version.begin() + 10, version.end());
  const base::Error none = base::Error::kNotReady;
  const std::array<fake::LinkStep, 5> script = {
      {{{}, none}, {first, {}}, {{}, base::Error::kGone}, {second, {}}, {{}, none}}};
  fake::ScriptedLink<128> link(script);
  Camera<fake::ScriptedLink<128>> camera(link, {});
  for (std::int64_t t = 10; t <= 20; t += 10) (void)camera.poll({t});
  EXPECT_EQ(camera.link(), LinkState::kAbsent);
  link.limit_writes(0);
  (void)camera.poll({30});
  EXPECT_EQ(camera.link(), LinkState::kSilent) << "its bytes show that the plug is in";
  EXPECT_EQ(camera.session().counters().malformed, 0U);
  EXPECT_EQ(camera.damaged(), 0U);
}

TEST(Pixy2Camera, StartsUpWithTheCamera) {
  Bench bench;
  bench.run(400, {kRed});
  EXPECT_EQ(bench.driver.link(), LinkState::kSilent);
  bench.run(700, {kRed});
  EXPECT_EQ(bench.driver.link(), LinkState::kUnready);  // busy: starting
  bench.run(1'000, {kRed, kSmall});
  EXPECT_EQ(bench.driver.link(), LinkState::kOk);
  ASSERT_FALSE(bench.frames.empty());
  EXPECT_EQ(bench.frames.back().blobs.size(), 2U);
  EXPECT_EQ(bench.frames.back().blobs[0], kRed);
}

TEST(Pixy2Camera, TakesEveryFrameOnceInOrder) {
  Bench bench;
  bench.run(3'000, {kRed});
  const std::size_t before = bench.frames.size();
  bench.run(1'600, {kRed});
  EXPECT_EQ(bench.frames.size() - before, 100U);
  for (std::size_t i = 1; i < bench.frames.size(); ++i) {
    EXPECT_GT(bench.frames[i].t, bench.frames[i - 1].t);
    EXPECT_EQ(bench.frames[i].frame, bench.frames[i - 1].frame + 1);
  }
}

TEST(Pixy2Camera, SeeingNothingIsEmpty) {
  Bench bench;
  bench.run(3'000, {});
  EXPECT_EQ(bench.driver.link(), LinkState::kEmpty);
  EXPECT_FALSE(bench.frames.empty());
  bench.run(100, {kRed});
  EXPECT_EQ(bench.driver.link(), LinkState::kOk);
}

TEST(Pixy2Camera, FirstByteStampsTheFrame) {
  Bench bench;
  bench.link.set_bytes_per_ms(2);
  bench.run(3'000, {kRed, kSmall});
  ASSERT_FALSE(bench.frames.empty());
  bench.frames.clear();
  while (bench.frames.empty()) bench.run(1, {kRed, kSmall});
  // 34 bytes at two a millisecond: the last comes 16 ms after the first.
  EXPECT_EQ((bench.clock.now() - bench.frames[0].t), base::milliseconds(16));
}

// A line at another rate, or beside a motor: 200 bytes a millisecond of anything, packets with wrong checksums among
// them.
TEST(Pixy2Camera, NoiseAloneIsNotOk) {
  Bench bench;
  bench.run(3'000, {kRed});
  ASSERT_EQ(bench.driver.link(), LinkState::kOk);
  bench.link.power(false);
  bench.link.set_bytes_per_ms(200);
  std::minstd_rand random(1);
  const std::uint32_t damaged = bench.driver.damaged();
  for (int ms = 0; ms < 10'000; ++ms) {
    std::vector<std::uint8_t> bytes(200);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random() >> 8U);
    if (ms % 100 == 0) std::copy_n(test::hex("AF C1 21 01 FF FF 00").begin(), 7, bytes.begin());
    bench.link.noise(bytes);
    bench.clock.advance(base::milliseconds(1));
    (void)bench.driver.poll(bench.clock.now());
    if (ms > 1'200) {
      ASSERT_NE(bench.driver.link(), LinkState::kOk) << ms;
    }
  }
  EXPECT_GT(bench.driver.damaged(), damaged + 50);
  bench.link.forget();
  bench.link.power(true);
  bench.link.set_bytes_per_ms(12);
  bench.run(2'000, {kRed});
  EXPECT_EQ(bench.driver.link(), LinkState::kOk);
}

TEST(Pixy2Camera, AnotherProgramIsChanged) {
  Bench bench;
  bench.device.set_default_program("line_tracking");
  bench.run(3'000, {kRed});
  EXPECT_EQ(bench.driver.link(), LinkState::kOk);
}

TEST(Pixy2Camera, AnotherProgramLeftAloneIsUnready) {
  Bench bench;
  bench.device.set_default_program("line_tracking");
  Camera<Link> camera(bench.link, {.select_program = false});
  for (int ms = 0; ms < 3'000; ++ms) {
    bench.clock.advance(base::milliseconds(1));
    (void)camera.poll(bench.clock.now());
  }
  EXPECT_EQ(camera.link(), LinkState::kUnready);
  EXPECT_GT(camera.session().counters().restarts, 0U);
}

TEST(Pixy2Camera, NoSignatureAskedForIsUnready) {
  Bench bench;
  Camera<Link> camera(bench.link, {.signatures = 0});
  for (int ms = 0; ms < 3'000; ++ms) {
    bench.clock.advance(base::milliseconds(1));
    EXPECT_FALSE(camera.poll(bench.clock.now()));
  }
  EXPECT_EQ(camera.link(), LinkState::kUnready);
}

TEST(Pixy2Camera, TheButtonIsUnreadyUntilLetGo) {
  Bench bench;
  bench.run(3'000, {kRed});
  bench.device.hold_button(true);
  bench.run(300, {kRed});
  EXPECT_EQ(bench.driver.link(), LinkState::kUnready);
  bench.device.hold_button(false);
  bench.run(300, {kRed});
  EXPECT_EQ(bench.driver.link(), LinkState::kOk);
}

TEST(Pixy2Camera, AFrozenSensorIsUnready) {
  Bench bench;
  bench.run(3'000, {kRed});
  for (int ms = 0; ms < 1'200; ++ms) {
    bench.clock.advance(base::milliseconds(1));
    (void)bench.driver.poll(bench.clock.now());
  }
  EXPECT_EQ(bench.driver.link(), LinkState::kUnready);
}

TEST(Pixy2Camera, ComesBackAfterAPowerCycle) {
  Bench bench;
  bench.run(3'000, {kRed});
  bench.device.restart(bench.clock.now());
  bench.run(450, {kRed});
  EXPECT_EQ(bench.driver.link(), LinkState::kSilent);
  bench.run(1'600, {kRed});
  EXPECT_EQ(bench.driver.link(), LinkState::kOk);
}

TEST(Pixy2Camera, UnpluggedIsAbsentAndReplugged) {
  Bench bench;
  bench.run(3'000, {kRed});
  bench.link.unplug();
  bench.run(10, {kRed});
  EXPECT_EQ(bench.driver.link(), LinkState::kAbsent);
  bench.run(5'000, {kRed});
  EXPECT_EQ(bench.driver.link(), LinkState::kAbsent);
  bench.link.replug();
  bench.run(600, {kRed});
  EXPECT_EQ(bench.driver.link(), LinkState::kOk);
}

TEST(Pixy2Camera, APortWithoutACameraIsSilent) {
  Bench bench;
  bench.device.restart(base::Time{1'000'000'000});
  bench.link.unplug();
  bench.run(100, {});
  EXPECT_EQ(bench.driver.link(), LinkState::kAbsent);
  bench.link.replug();
  bench.run(1'000, {});
  EXPECT_EQ(bench.driver.link(), LinkState::kSilent);
}

TEST(Pixy2Camera, CountsWhatSixteenCannotHold) {
  Bench bench;
  std::vector<sensor::Blob> many;
  for (std::int16_t i = 0; i < 18; ++i)
    many.push_back({1, i, 10, static_cast<std::int16_t>(i + 5 + i), 20, {}, {}, 0, {}});
  bench.run(3'000, many);
  ASSERT_FALSE(bench.frames.empty());
  EXPECT_EQ(bench.frames.back().blobs.size(), 16U);
  EXPECT_EQ(bench.driver.dropped(), 2U * bench.frames.size());
}

TEST(Pixy2Camera, AStalledLineEndsTheWait) {
  Bench bench;
  bench.run(3'000, {kRed});
  bench.link.stall();
  bench.run(400, {kRed});
  EXPECT_EQ(bench.driver.link(), LinkState::kSilent);
  bench.link.resume();
  bench.run(800, {kRed});
  EXPECT_EQ(bench.driver.link(), LinkState::kOk);
}

}  // namespace
}  // namespace fencepost::pixy2
