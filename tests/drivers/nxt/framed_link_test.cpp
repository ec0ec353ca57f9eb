#include "drivers/nxt/framed_link.hpp"

#include <gtest/gtest.h>

#include "hal/fake/scripted_link.hpp"
#include "tests/drivers/hex.hpp"

namespace fencepost::nxt {
namespace {

using base::Error;
using test::bytes_of;
using test::hex;
using Bytes = std::vector<std::uint8_t>;
using Link = fake::ScriptedLink<64>;

static_assert(bus::PacketLink<FramedLink<Link>>);

const Bytes kAlive = hex("07 00 02 0D 00 C0 27 09 00");

TEST(NxtFramedLink, PutsTheDocumentedLengthInFront) {
  Link link({});
  FramedLink<Link> framed(link);
  EXPECT_EQ(framed.send(sensor_write(0, 0x01, hex("42"), 11).view()).value(), 7U);
  EXPECT_EQ(bytes_of(link.written()), hex("07 00 00 0F 00 02 0B 02 42"));
}

TEST(NxtFramedLink, WhatItsFirstBytesAre) {
  const auto front = [](const char* text) { return examine_framed(hex(text)).front; };
  EXPECT_EQ(front("07"), wire::Front::kIncomplete);
  EXPECT_EQ(front("02 00"), wire::Front::kDamaged) << "a reply has three bytes at least";
  EXPECT_EQ(front("03 00"), wire::Front::kIncomplete);
  EXPECT_EQ(front("40 00"), wire::Front::kIncomplete);
  EXPECT_EQ(front("41 00"), wire::Front::kDamaged) << "and 64 at most";
  EXPECT_EQ(front("03 01"), wire::Front::kDamaged) << "259";
  EXPECT_EQ(examine_framed(hex("41 00 02")).size, 1U);
  EXPECT_EQ(front("07 00 03"), wire::Front::kDamaged) << "no reply";
  EXPECT_EQ(examine_framed(hex("07 00 03")).size, 1U);
  EXPECT_EQ(front("07 00 02"), wire::Front::kIncomplete);
  const Bytes prefix = hex("07 00 03");
  EXPECT_EQ(examine_framed(std::span(prefix).first(2)).front, wire::Front::kIncomplete) << "the third is yet to come";
  EXPECT_EQ(front("03 00 02 0F"), wire::Front::kIncomplete);
  EXPECT_EQ(front("03 00 02 0F 00"), wire::Front::kMessage);
  EXPECT_EQ(examine_framed(hex("03 00 02 0F 00 07")).size, 5U);
}

TEST(NxtFramedLink, SendingGivesUpWhatHadBegun) {
  const Bytes part = hex("40 00 02");
  const std::array<fake::LinkStep, 3> steps = {{{part, {}}, {{}, Error::kNotReady}, {kAlive, {}}}};
  Link link(steps);
  FramedLink<Link> framed(link);
  std::array<std::uint8_t, 64> in{};
  EXPECT_EQ(framed.receive(in).error(), Error::kNotReady);
  EXPECT_TRUE(framed.send(keep_alive().view()));
  EXPECT_EQ(framed.receive(in).value(), 7U);
}

TEST(NxtFramedLink, SendsInPartsAndRefusesASecond) {
  Link link({});
  link.limit_writes(3);
  FramedLink<Link> framed(link);
  std::array<std::uint8_t, 64> in{};
  EXPECT_TRUE(framed.send(sensor_write(0, 0x01, hex("42"), 11).view()));
  EXPECT_EQ(framed.send(keep_alive().view()).error(), Error::kFull);  // six of nine bytes are out
  EXPECT_EQ(framed.receive(in).error(), Error::kNotReady);
  EXPECT_TRUE(framed.send(keep_alive().view()));
  EXPECT_EQ(framed.send(std::array<std::uint8_t, 65>{}).error(), Error::kFull);
}

TEST(NxtFramedLink, SmallBuffersAndGoneLinks) {
  const std::array<fake::LinkStep, 2> steps = {{{kAlive, {}}, {{}, Error::kGone}}};
  Link link(steps);
  FramedLink<Link> framed(link);
  std::array<std::uint8_t, 4> in{};
  EXPECT_EQ(framed.receive(in).error(), Error::kBadInput);
  EXPECT_EQ(framed.receive(in).error(), Error::kGone);
  link.unplug();
  EXPECT_EQ(framed.send(keep_alive().view()).error(), Error::kGone);
}

TEST(NxtFramedLink, ALinkThatGoesWhileSomethingWaits) {
  for (const bool sending : {true, false}) {
    Link link({});
    link.limit_writes(3);
    FramedLink<Link> framed(link);
    EXPECT_TRUE(framed.send(sensor_write(0, 0x01, hex("42"), 11).view()));
    link.unplug();
    std::array<std::uint8_t, 64> in{};
    EXPECT_EQ(sending ? framed.send(keep_alive().view()).error() : framed.receive(in).error(), Error::kGone);
    link.replug();
    EXPECT_TRUE(framed.send(keep_alive().view())) << "what waited is forgotten";
  }
}

// Two whole telegrams a call at most, whatever comes.
TEST(NxtFramedLink, NoiseDoesNotHoldItUp) {
  Bytes noise(2 * 66, 0xFF);
  noise.insert(noise.end(), kAlive.begin(), kAlive.end());
  const std::array<fake::LinkStep, 1> steps = {{{noise, {}}}};
  Link link(steps);
  FramedLink<Link> framed(link);
  std::array<std::uint8_t, 64> in{};
  EXPECT_EQ(framed.receive(in).error(), Error::kNotReady);
  EXPECT_EQ(framed.receive(in).value(), 7U);
}

}  // namespace
}  // namespace fencepost::nxt
