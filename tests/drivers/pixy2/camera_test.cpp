// The pump, against scripted bytes and against the emulated camera.
#include "drivers/pixy2/camera.hpp"

#include <gtest/gtest.h>

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
/// As the driver gives it, from a block of this index.
sensor::Blob tracked(sensor::Blob blob, std::uint16_t index) {
  blob.track = static_cast<std::uint16_t>(index + 1);
  return blob;
}
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
  EXPECT_EQ(seen->blobs[0], tracked(kRed, 7));
  EXPECT_EQ(camera.session().version()->build, 20);
  std::vector<std::uint8_t> expected = hex("AF C1 0E 00 00 00");
  for (const auto& part : {bytes_of(request_program()), hex("AF C1 0C 01 00 00 00"), hex("AF C1 20 02 FE 01 FF FF")}) {
    expected.insert(expected.end(), part.begin(), part.end());
  }
  EXPECT_EQ(bytes_of(link.written()), expected);
}

// The effect of each of the camera's errors on a session that asks for blocks.
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
  EXPECT_EQ(bench.frames.back().blobs[0], tracked(kRed, 0));
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

}  // namespace
}  // namespace fencepost::pixy2
