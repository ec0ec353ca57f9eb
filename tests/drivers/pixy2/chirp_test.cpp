// USB: the documented messages, and the camera's driver over them.
#include "drivers/chirp/chirp.hpp"

#include <gtest/gtest.h>

#include "tests/drivers/bench/pixy2_rig.hpp"
#include "tests/drivers/hex.hpp"

namespace fencepost::pixy2 {
namespace {

using UsbBench = test::Bench<test::Pixy2UsbRig>;
using sensor::LinkState;
using test::bytes_of;
using test::hex;

std::vector<std::uint8_t> padded(std::vector<std::uint8_t> bytes) {
  bytes.resize(64, 0);
  return bytes;
}

TEST(Chirp, DocumentedMessages) {
  EXPECT_EQ(bytes_of(chirp::initialise()), padded(hex("55 55 AA AA A1 00 00 00 06 00 00 00 02 02 40 00 01 01")));
  EXPECT_EQ(bytes_of(chirp::enumerate("run")),
            padded(hex("55 55 AA AA A0 00 00 00 08 00 00 00 A1 72 75 6E 00 02 FF FF")));
}

// By the rules of alignment: the type at 12, the array's count at 16.
TEST(Chirp, CallsCarryTypeAndData) {
  EXPECT_EQ(bytes_of(chirp::call(5, 0x20, hex("FF FF"))),
            padded(hex("55 55 AA AA 80 00 05 00 0A 00 00 00 01 20 81 81 02 00 00 00 FF FF")));
}

TEST(Chirp, RepliesAreRead) {
  const auto init = chirp::message_in(hex("55 55 AA AA 61 00 00 00 06 00 00 00 00 00 00 00 01 01"));
  ASSERT_TRUE(init);
  EXPECT_EQ(init->type, chirp::Type::kInitialised);
  EXPECT_EQ(init->result, 0);
  const auto index = chirp::message_in(hex("55 55 AA AA 60 00 00 00 04 00 00 00 05 00 00 00"));
  EXPECT_EQ(index->result, 5);
  const auto bytes = hex("55 55 AA AA 40 00 FF FF 0D 00 00 00 00 00 00 00 01 03 81 81 01 00 00 00 FE");
  const auto packet = chirp::packet_in(*chirp::message_in(bytes));
  ASSERT_TRUE(packet);
  EXPECT_EQ(packet->type, 0x03);
  EXPECT_EQ(bytes_of(packet->data), hex("FE"));
}

// Of 320 bytes the header is 12.
TEST(Chirp, TheLongestThatIsReadAndTheFirstThatIsNot) {
  const auto message = [](unsigned length) {
    std::vector<std::uint8_t> bytes = hex("55 55 AA AA 40 00 FF FF 00 00 00 00");
    bytes[8] = static_cast<std::uint8_t>(length & 0xFFU);
    bytes[9] = static_cast<std::uint8_t>(length >> 8U);
    bytes.resize(bytes.size() + length, 0x11);
    return bytes;
  };
  EXPECT_EQ(chirp::examine(message(308)).front, wire::Front::kMessage);
  EXPECT_EQ(chirp::examine(message(308)).size, 320U);
  EXPECT_EQ(chirp::examine(message(309)).front, wire::Front::kNoise);
  EXPECT_EQ(chirp::examine(message(309)).size, 1U) << "the second 55 may begin one";
  EXPECT_EQ(chirp::examine(message(0)).size, 12U) << "a header alone";
  const std::vector<std::uint8_t> whole = message(4);
  for (std::size_t size = 1; size < whole.size(); ++size) {
    EXPECT_EQ(chirp::examine(std::span(whole).first(size)).front, wire::Front::kIncomplete) << size;
  }
  EXPECT_EQ(chirp::examine(whole).size, 16U);
  for (std::size_t at = 0; at < 4; ++at) {
    std::vector<std::uint8_t> damaged = whole;
    damaged[at] ^= 1U;
    EXPECT_EQ(chirp::examine(std::span(damaged).first(4)).front, wire::Front::kNoise) << at;
  }
}

TEST(Chirp, PacketsOfOtherTypesOrLengthsAreNone) {
  const auto packet = [](const char* rest) {
    const auto bytes = hex(rest);
    return chirp::packet_in({chirp::Type::kResponse, 0, bytes}).has_value();
  };
  EXPECT_TRUE(packet("01 03 81 81 01 00 00 00 FE"));
  EXPECT_TRUE(packet("01 03 81 81 00 00 00 00")) << "without data";
  EXPECT_FALSE(packet("01 03 81 81 00 00 00"));
  EXPECT_FALSE(packet("02 03 81 81 01 00 00 00 FE"));
  EXPECT_FALSE(packet("01 03 82 81 01 00 00 00 FE"));
  EXPECT_FALSE(packet("01 03 81 81 02 00 00 00 FE"));
  EXPECT_FALSE(packet("01 03 81 81 00 00 00 00 FE"));
  for (const std::size_t count : {255U, 256U}) {
    std::vector<std::uint8_t> rest = hex("01 03 81 81 00 00 00 00");
    rest[4] = static_cast<std::uint8_t>(count & 0xFFU);
    rest[5] = static_cast<std::uint8_t>(count >> 8U);
    rest.resize(rest.size() + count, 0x22);
    EXPECT_EQ(chirp::packet_in({chirp::Type::kResponse, 0, rest}).has_value(), count == 255) << count;
  }
  EXPECT_FALSE(chirp::message_in(hex("55 55 AA AA 60 00 00 00 03 00 00 00 05 00 00"))) << "no whole result";
  EXPECT_TRUE(chirp::message_in(hex("55 55 AA AA 60 00 00 00 04 00 00 00 05 00 00 00")));
}

const sensor::Blob kUsbRed{1, 138, 89, 177, 119, {1575}, {1040}, 0, {}};

TEST(ChirpLink, RunsTheCamera) {
  UsbBench bench;
  bench.run(3'000, {kUsbRed});
  EXPECT_EQ(bench.driver.link(), LinkState::kOk);
  EXPECT_EQ(bench.driver.session().version()->build, 20);
  ASSERT_FALSE(bench.frames.empty());
  sensor::Blob first = kUsbRed;
  first.track = 1;
  EXPECT_EQ(bench.frames.back().blobs[0], first);
  const std::size_t before = bench.frames.size();
  bench.run(1'600, {kUsbRed});
  EXPECT_EQ(bench.frames.size() - before, 100U);
}

// Reset between the two messages that open the connection: it answers the second one only after the first.
TEST(ChirpLink, ACameraResetWhileTheConnectionOpensIsOpenedAnew) {
  UsbBench bench;
  while (bench.link.waiting() == 0) bench.run(1, {kUsbRed});  // the answer to the first one is on its way
  bench.usb.restart(bench.clock.now());
  bench.run(8'000, {kUsbRed});
  EXPECT_EQ(bench.driver.link(), LinkState::kOk);
}

}  // namespace
}  // namespace fencepost::pixy2
