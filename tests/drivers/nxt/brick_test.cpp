// The pump: scripted telegrams, and the emulated brick asleep, restarted, unplugged.
#include "drivers/nxt/brick.hpp"

#include <gtest/gtest.h>

#include "hal/fake/scripted_packets.hpp"
#include "tests/drivers/bench/nxt_rig.hpp"
#include "tests/drivers/hex.hpp"

namespace fencepost::nxt {
namespace {

using sensor::LinkState;
using test::bytes_of;
using test::hex;

TEST(NxtBrick, ExchangesTelegrams) {
  const auto version = hex("02 88 00 7C 01 1D 01");
  const auto alive = hex("02 0D 00 C0 27 09 00");
  const std::array<fake::PacketStep, 3> script = {{{version, {}, 1}, {{}, base::Error::kBadInput, 1}, {alive, {}, 2}}};
  fake::ScriptedPackets<8> link(script);
  Brick<fake::ScriptedPackets<8>> brick(link);
  for (int ms = 0; ms < 10; ++ms) brick.poll(base::Time{ms * 10});
  EXPECT_EQ(brick.link(), LinkState::kOk);
  ASSERT_EQ(link.sent().size(), 3U);
  EXPECT_EQ(bytes_of(link.sent()[0]), hex("01 88"));
  EXPECT_EQ(bytes_of(link.sent()[1]), hex("00 0D"));
  EXPECT_EQ(bytes_of(link.sent()[2]), hex("00 0B"));
}

struct BarredLink {
  base::Error error = base::Error::kFull;
  [[nodiscard]] base::Result<std::size_t> send(std::span<const std::uint8_t> /*out*/) const { return error; }
  static base::Result<std::size_t> receive(std::span<std::uint8_t> /*in*/) { return base::Error::kNotReady; }
};

TEST(NxtBrick, AFullLinkIsNoLostOne) {
  BarredLink link;
  Brick<BarredLink> brick(link);
  brick.poll({0});
  EXPECT_EQ(brick.link(), LinkState::kSilent);
  link.error = base::Error::kGone;
  for (std::int64_t ms = 1; ms < 1'000; ++ms) brick.poll({10 * ms});
  EXPECT_EQ(brick.link(), LinkState::kAbsent);
}

using Bench = test::Bench<test::NxtBrickRig<test::UsbBrick>>;

TEST(NxtBrick, StaysAwake) {
  Bench bench;
  bench.device.set_sleep_time(base::milliseconds(120'000));
  bench.run(600'000);
  EXPECT_EQ(bench.brick.link(), LinkState::kOk);
  EXPECT_TRUE(bench.device.on(bench.clock.now()));
}

TEST(NxtBrick, SlowRepliesAreNotLost) {
  Bench bench;
  bench.run(4'000);
  bench.link.delay = base::milliseconds(350);  // longer than we wait
  bench.run(60'000);
  EXPECT_EQ(bench.brick.link(), LinkState::kOk);
  EXPECT_GT(bench.brick.conversation().counters().timeouts, 5U);
  EXPECT_EQ(bench.brick.conversation().counters().failed, 0U);
}

}  // namespace
}  // namespace fencepost::nxt
