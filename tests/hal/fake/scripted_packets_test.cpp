#include "hal/fake/scripted_packets.hpp"

#include <gtest/gtest.h>

#include <array>

namespace fencepost::fake {
namespace {

using base::Error;

constexpr std::array<std::uint8_t, 3> kPacket = {1, 2, 3};

TEST(ScriptedPackets, AnswersWhenAskedEnough) {
  const std::array<PacketStep, 3> script = {{{kPacket, {}, 1}, {{}, Error::kBadInput, 1}, {kPacket, {}, 2}}};
  ScriptedPackets<2> link(script);
  std::array<std::uint8_t, 8> in{};
  EXPECT_EQ(link.receive(in).error(), Error::kNotReady);
  EXPECT_EQ(link.send(kPacket).value(), 3U);
  EXPECT_EQ(link.receive(in).value(), 3U);
  EXPECT_EQ(in[2], 3);
  EXPECT_EQ(link.receive(in).error(), Error::kBadInput);
  EXPECT_EQ(link.receive(in).error(), Error::kNotReady);
  EXPECT_EQ(link.send(kPacket).value(), 3U);
  EXPECT_EQ(link.send(kPacket).error(), Error::kFull);
  EXPECT_EQ(link.receive(std::span(in).first(2)).error(), Error::kBadInput);
  EXPECT_TRUE(link.finished());
  EXPECT_EQ(link.receive(in).error(), Error::kNotReady);
  ASSERT_EQ(link.sent().size(), 2U);
  EXPECT_EQ(link.sent()[1][0], 1);
}

TEST(ScriptedPackets, UnpluggedIsGone) {
  ScriptedPackets<2> link({});
  std::array<std::uint8_t, 8> in{};
  link.unplug();
  EXPECT_EQ(link.send(kPacket).error(), Error::kGone);
  EXPECT_EQ(link.receive(in).error(), Error::kGone);
  link.replug();
  EXPECT_EQ(link.send(kPacket).value(), 3U);
  EXPECT_EQ(link.send(std::array<std::uint8_t, 65>{}).error(), Error::kFull);
}

}  // namespace
}  // namespace fencepost::fake
