// The pump over I2C: scripted transfers, and the emulated camera.
#include "drivers/nxtcam/camera.hpp"

#include <gtest/gtest.h>

#include "hal/fake/scripted_i2c.hpp"
#include "tests/drivers/bench/nxtcam_rig.hpp"
#include "tests/drivers/hex.hpp"

namespace fencepost::nxtcam {
namespace {

using sensor::LinkState;
using test::hex;
using Bus = test::I2cCable;
using Bench = test::Bench<test::NxtCamRig>;

static_assert(sensor::BlobCamera<Camera<Bus>>);

const sensor::Blob kRed{2, 60, 40, 81, 70, {705}, {550}, 0, {}};
const sensor::Blob kBlue{5, 100, 100, 121, 131, {1105}, {1155}, 0, {}};

TEST(NxtCamera, StartsWithTheDocumentedTransfers) {
  const auto version = hex("56 31 2E 32 30 00 00 00");
  const auto product = hex("6D 6E 64 73 6E 73 72 73 4E 58 54 43 61 6D 00 00");
  const auto map = hex("01 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00");
  const auto two = hex("02 02 3C 28 50 46 05 64 64 78 83 00 00 00 00 00");
  const fake::I2cStep ok{};
  const std::array<fake::I2cStep, 11> script = {
      {{version, {}, 0}, {product, {}, 0}, ok, ok, {map, {}, 0}, {map, {}, 0}, {map, {}, 0}, ok, ok, ok, {two, {}, 0}}};
  fake::ScriptedI2c<16> bus(script);
  Camera<fake::ScriptedI2c<16>> camera(bus);
  std::optional<sensor::BlobFrame> seen;
  for (int ms = 1; ms < 2'000 && !seen; ++ms) {
    if (const auto frame = camera.poll(base::Time{ms * 10})) seen = *frame;
  }
  ASSERT_TRUE(seen);
  ASSERT_EQ(seen->blobs.size(), 2U);
  EXPECT_EQ(seen->blobs[0], kBlue);
  EXPECT_EQ(seen->blobs[1], kRed);
  EXPECT_EQ(camera.session().version().view(), "V1.20");
  // D, G, A, B, E, each 200 ms apart.
  EXPECT_GT(seen->t, base::Time{10'000});
  std::string commands;
  for (const fake::I2cTransfer& transfer : bus.transfers()) {
    EXPECT_EQ(transfer.address, 0x01);
    EXPECT_LE(transfer.expected, 16U);
    if (transfer.out.size() == 2) {
      EXPECT_EQ(transfer.out[0], 0x41);
      commands += static_cast<char>(transfer.out[1]);
    }
  }
  EXPECT_EQ(commands, "DGABE");
  EXPECT_EQ(bus.transfers()[10].out[0], 0x42);
  EXPECT_EQ(bus.transfers()[10].expected, 16U);
}

struct TakenBus {
  static base::Result<std::size_t> begin(std::uint8_t /*address*/, std::span<const std::uint8_t> /*out*/,
                                         std::size_t /*expected*/) {
    return base::Error::kFull;
  }
  static base::Result<std::size_t> finish(std::span<std::uint8_t> /*in*/) { return base::Error::kNotReady; }
};

TEST(NxtCamera, ABusThatAnotherHasIsWaitedForASecond) {
  TakenBus bus;
  Camera<TakenBus> camera(bus);
  for (std::int64_t ms = 1; ms <= 1'001; ++ms) (void)camera.poll({10 * ms});
  EXPECT_EQ(camera.session().counters().refused, 0U);
  (void)camera.poll({10'020});
  EXPECT_EQ(camera.session().counters().refused, 1U);
}

// To the first count of objects, which is answered.
Session tracking(base::Time& now) {
  Session session{Options{}};
  const auto product = hex("6D 6E 64 73 6E 73 72 73 4E 58 54 43 61 6D 00 00");
  const auto map = hex("01 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00");
  const auto one = hex("01 02 3C 28 50 46 00 00 00 00 00 00 00 00 00 00");
  for (const auto& answer : {hex("56 31 2E 32 30 00 00 00"), product, {}, {}, map, map, map, {}, {}, {}, one}) {
    now = now + base::milliseconds(1'000);
    EXPECT_TRUE(session.due(now));
    session.take(answer, now);
  }
  return session;
}

TEST(NxtCamera, ThreeFailuresInARowAreSilence) {
  base::Time now{0};
  Session session = tracking(now);
  EXPECT_EQ(session.link(), LinkState::kOk);
  const auto fail = [&](base::Error error) {
    now = now + base::milliseconds(1'000);
    EXPECT_TRUE(session.due(now));
    session.fail(error, now);
  };
  for (int round = 0; round < 2; ++round) {
    fail(base::Error::kRefused);
    fail(base::Error::kRefused);
    EXPECT_EQ(session.link(), round == 0 ? LinkState::kOk : LinkState::kEmpty) << round;
    now = now + base::milliseconds(1'000);
    const auto asked = session.due(now);
    ASSERT_TRUE(asked);
    session.take(std::vector<std::uint8_t>(asked->expected, 0), now);
  }
  EXPECT_EQ(session.counters().restarts, 0U);
  fail(base::Error::kRefused);
  fail(base::Error::kRefused);
  EXPECT_NE(session.link(), LinkState::kSilent);
  fail(base::Error::kRefused);
  EXPECT_EQ(session.link(), LinkState::kSilent);
  EXPECT_EQ(session.counters().restarts, 1U);
  EXPECT_EQ(session.counters().refused, 7U);
  fail(base::Error::kRefused);
  EXPECT_EQ(session.counters().restarts, 1U) << "it has not begun";
  fail(base::Error::kGone);
  EXPECT_EQ(session.link(), LinkState::kAbsent);
}

TEST(NxtCamera, AMissingBusIsAbsentAtOnce) {
  base::Time now{0};
  Session session = tracking(now);
  now = now + base::milliseconds(1'000);
  EXPECT_TRUE(session.due(now));
  session.fail(base::Error::kGone, now);
  EXPECT_EQ(session.link(), LinkState::kAbsent);
  EXPECT_EQ(session.counters().restarts, 1U);
}

TEST(NxtCamera, NothingTaughtIsUnreadyUntilTaught) {
  Bench bench;
  bench.device.teach(0);
  bench.run(5'000, {kRed});
  EXPECT_EQ(bench.driver.link(), LinkState::kUnready);
  EXPECT_TRUE(bench.frames.empty());
  bench.device.teach(0x24);
  bench.run(4'000, {kRed});
  EXPECT_EQ(bench.driver.link(), LinkState::kOk);
}

TEST(NxtCamera, TheMapIsNotAskedForIfSoTold) {
  Bench bench(test::Damage{}, Options{.check_colour_map = false});
  bench.device.teach(0);
  bench.run(4'000, {kRed});
  EXPECT_EQ(bench.driver.link(), LinkState::kOk);
}

TEST(NxtCamera, AnotherSensorIsUnready) {
  Bench bench;
  bench.device.set_product("DIST-L");
  bench.run(4'000, {kRed});
  EXPECT_EQ(bench.driver.link(), LinkState::kUnready);
  EXPECT_FALSE(bench.device.tracking());
  bench.device.set_product("NXTCam");
  bench.run(3'000, {kRed});
  EXPECT_EQ(bench.driver.link(), LinkState::kOk);
}

// Tracking is off after a reset that no transfer noticed: the camera seems to see nothing.
TEST(NxtCamera, AnUnnoticedResetIsRepaired) {
  Bench bench;
  bench.run(3'000, {kRed});
  bench.device.restart(bench.clock.now() - emulate::NxtCam::kBoot);
  bench.run(1'000, {kRed});
  EXPECT_EQ(bench.driver.link(), LinkState::kEmpty);
  bench.run(5'000, {kRed});
  EXPECT_EQ(bench.driver.link(), LinkState::kOk);
}

TEST(NxtCamera, LocksTheBufferIfSoTold) {
  Bench bench(test::Damage{}, Options{.lock_buffer = true});
  bench.run(4'000, {kRed});
  EXPECT_EQ(bench.driver.link(), LinkState::kOk);
  EXPECT_EQ(bench.frames.back().blobs[0], kRed);
}

TEST(NxtCamera, ImpossibleCountsAndObjectsRejectTheirFrame) {
  Session session({.check_colour_map = false});
  base::Time t{};
  const auto answer = [&](const std::vector<std::uint8_t>& bytes) {
    while (!session.due(t)) t = t + base::milliseconds(1);
    session.take(bytes, t);
  };
  answer(hex("56 31 2E 32 30 00 00 00"));
  answer(hex("6D 6E 64 73 6E 73 72 73 4E 58 54 43 61 6D 00 00"));
  for (int i = 0; i < 4; ++i) answer({});
  answer(hex("09 02 3C 28 50 46 05 64 64 78 82 00 00 00 00 00"));
  EXPECT_EQ(session.counters().rejected, 1U);
  answer(hex("02 02 3C 28 50 46 05 64 64 63 82 00 00 00 00 00"));
  EXPECT_EQ(session.counters().rejected, 2U);
  EXPECT_FALSE(session.take_frame());
  answer(hex("01 02 3C 28 50 46 05 64 64 63 82 00 00 00 00 00"));
  EXPECT_EQ(session.take_frame()->blobs.size(), 1U);
  answer(hex("01 02"));  // short
  EXPECT_EQ(session.counters().refused, 1U);
  EXPECT_FALSE(session.take_frame());
}

}  // namespace
}  // namespace fencepost::nxtcam
