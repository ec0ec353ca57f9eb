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

std::vector<Bytes> received(const std::vector<Bytes>& chunks) {
  std::vector<fake::LinkStep> script;
  for (const Bytes& chunk : chunks) script.push_back({chunk, {}});
  Link link(script);
  FramedLink<Link> framed(link);
  std::vector<Bytes> telegrams;
  std::array<std::uint8_t, 64> in{};
  for (int i = 0; i < 200; ++i) {
    if (const auto got = framed.receive(in)) telegrams.emplace_back(in.begin(), in.begin() + static_cast<long>(*got));
  }
  return telegrams;
}

const Bytes kAlive = hex("07 00 02 0D 00 C0 27 09 00");
const Bytes kAliveTelegram = hex("02 0D 00 C0 27 09 00");
const Bytes kWritten = hex("03 00 02 0F 00");

TEST(NxtFramedLink, PutsTheDocumentedLengthInFront) {
  Link link({});
  FramedLink<Link> framed(link);
  EXPECT_EQ(framed.send(sensor_write(0, 0x01, hex("42"), 11).view()).value(), 7U);
  EXPECT_EQ(bytes_of(link.written()), hex("07 00 00 0F 00 02 0B 02 42"));
}

TEST(NxtFramedLink, FindsTelegramsSplitAnywhere) {
  Bytes all = kAlive;
  all.insert(all.end(), kWritten.begin(), kWritten.end());
  for (std::size_t cut = 0; cut <= all.size(); ++cut) {
    const Bytes first(all.begin(), all.begin() + static_cast<long>(cut));
    const Bytes second(all.begin() + static_cast<long>(cut), all.end());
    EXPECT_EQ(received({first, second}), (std::vector<Bytes>{kAliveTelegram, hex("02 0F 00")})) << cut;
  }
}

TEST(NxtFramedLink, SkipsGarbage) {
  EXPECT_EQ(received({hex("FF FF 00 00 02 01 41 00 55"), kAlive}), (std::vector<Bytes>{kAliveTelegram}));
  EXPECT_EQ(received({hex("07 00 03 0D"), kAlive}), (std::vector<Bytes>{kAliveTelegram}));
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

struct EmptyReads {
  static base::Result<std::size_t> read(std::span<std::uint8_t> /*in*/) { return std::size_t{0}; }
  static base::Result<std::size_t> write(std::span<const std::uint8_t> out) { return out.size(); }
};

TEST(NxtFramedLink, AReadOfNothingIsNotReady) {
  EmptyReads link;
  FramedLink<EmptyReads> framed(link);
  std::array<std::uint8_t, 64> in{};
  EXPECT_EQ(framed.receive(in).error(), Error::kNotReady);
}

}  // namespace
}  // namespace fencepost::nxt
