// The telegrams of the protocol's description, byte by byte.
#include "drivers/nxt/telegram.hpp"

#include <gtest/gtest.h>

#include "tests/drivers/hex.hpp"

namespace fencepost::nxt {
namespace {

using test::bytes_of;
using test::hex;

TEST(NxtTelegram, RequestsAreTheDocumentedBytes) {
  EXPECT_EQ(bytes_of(get_version()), hex("01 88"));
  EXPECT_EQ(bytes_of(get_output_state(2)), hex("00 06 02"));
  EXPECT_EQ(bytes_of(get_battery()), hex("00 0B"));
  EXPECT_EQ(bytes_of(keep_alive()), hex("00 0D"));
  EXPECT_EQ(bytes_of(set_i2c_port(3)), hex("00 05 03 0B 00"));
  EXPECT_EQ(bytes_of(sensor_status(1)), hex("00 0E 01"));
  EXPECT_EQ(bytes_of(sensor_read(1)), hex("00 10 01"));
  EXPECT_EQ(bytes_of(sensor_write(0, 0x01, hex("42"), 11)), hex("00 0F 00 02 0B 02 42"));
}

TEST(NxtTelegram, DocumentedReplies) {
  const auto version = hex("02 88 00 7C 01 1D 01");
  EXPECT_EQ(version_of(*reply_in(version)), (Version{1, 124, 1, 29}));
  const auto battery = hex("02 0B 00 78 1E");
  EXPECT_EQ(battery_millivolts_of(*reply_in(battery)), 7800);
  EXPECT_TRUE(reply_in(hex("02 0D 00 C0 27 09 00")));
  const auto output = hex("02 06 00 01 4B 07 01 00 20 00 00 00 00 D2 04 00 00 9C FF FF FF D2 04 00 00");
  EXPECT_EQ(tacho_of(*reply_in(output)), 1234);
  const auto back = hex("02 06 00 01 4B 07 01 00 20 00 00 00 00 9C FF FF FF 00 00 00 00 00 00 00 00");
  EXPECT_EQ(tacho_of(*reply_in(back)), -100);
  const auto bytes = hex("02 10 00 0B 02 02 3C 28 50 46 05 64 64 78 82 00 00 00 00 00");
  EXPECT_EQ(bytes_of(sensor_bytes_of(*reply_in(bytes))), hex("02 02 3C 28 50 46 05 64 64 78 82"));
  const auto ready = hex("02 0E 00 0B");
  EXPECT_EQ(ready_bytes_of(*reply_in(ready)), 11);
}

TEST(NxtTelegram, WhatIsNoReplyIsNone) {
  EXPECT_FALSE(reply_in({}));
  EXPECT_FALSE(reply_in(hex("02 0D")));
  EXPECT_FALSE(reply_in(hex("01 0D 00 C0 27 09 00"))) << "a command";
  EXPECT_FALSE(reply_in(hex("03 0D 00 C0 27 09 00")));
  EXPECT_FALSE(reply_in(hex("00 06 00")));
  EXPECT_FALSE(reply_in(hex("02 0D 00 C0 27 09")));        // short
  EXPECT_FALSE(reply_in(hex("02 0D 00 C0 27 09 00 00")));  // long
  EXPECT_FALSE(reply_in(hex("02 77 00")));                 // unknown
  EXPECT_FALSE(reply_in(hex("02 0F C0 00")));              // an error longer than the reply
}

TEST(NxtTelegram, ErrorsMayBeShortOrFilled) {
  EXPECT_EQ(reply_in(hex("02 06 C0"))->status, status::kOutOfRange);
  EXPECT_EQ(reply_in(hex("02 06 C0 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00"))->status,
            status::kOutOfRange);
  EXPECT_EQ(reply_in(hex("02 0E 20 00"))->status, status::kPending);
}

TEST(NxtTelegram, RepliesMatchByOpcodeAndPort) {
  const auto port1 = hex("02 06 00 01 4B 07 01 00 20 00 00 00 00 D2 04 00 00 9C FF FF FF D2 04 00 00");
  EXPECT_TRUE(answers(*reply_in(port1), get_output_state(1)));
  EXPECT_FALSE(answers(*reply_in(port1), get_output_state(2)));
  EXPECT_FALSE(answers(*reply_in(port1), get_battery()));
  EXPECT_TRUE(answers(*reply_in(hex("02 06 C0")), get_output_state(7)));
}

}  // namespace
}  // namespace fencepost::nxt
