#include "hal/base/fnv1a.hpp"

#include <gtest/gtest.h>

#include <string_view>

namespace fencepost::base {
namespace {

std::uint64_t hash(std::string_view text) {
  Fnv1a64 digest;
  for (const char c : text) digest.u8(static_cast<std::uint8_t>(c));
  return digest.value();
}

// The published test suite of the FNV authors.
TEST(Fnv1a64, AnswersThePublishedVectors) {
  EXPECT_EQ(hash(""), 0xcbf29ce484222325ULL);
  EXPECT_EQ(hash("a"), 0xaf63dc4c8601ec8cULL);
  EXPECT_EQ(hash("foobar"), 0x85944171f73967e8ULL);
}

TEST(Fnv1a64, WritesIntegersLittleEndian) {
  Fnv1a64 wide;
  wide.u16(0x0201);
  wide.u32(0x06050403);
  wide.i64(0x0e0d0c0b0a090807);
  EXPECT_EQ(wide.value(), hash("\x01\x02\x03\x04\x05\x06\x07\x08\x09\x0a\x0b\x0c\x0d\x0e"));
}

TEST(Fnv1a64, WritesNegativesAsTwosComplement) {
  Fnv1a64 wide;
  wide.i32(-2);
  wide.i64(-1);
  EXPECT_EQ(wide.value(), hash("\xfe\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff"));
}

TEST(Fnv1a64, WritesFloatsAsTheirBits) {
  Fnv1a64 wide;
  wide.f32(1.0F);
  wide.f32(-2.5F);
  EXPECT_EQ(wide.value(), hash({"\x00\x00\x80\x3f\x00\x00\x20\xc0", 8}));
}

TEST(Fnv1a64, TellsTheTwoZeroesApart) {
  Fnv1a64 positive;
  positive.f32(0.0F);
  Fnv1a64 negative;
  negative.f32(-0.0F);
  EXPECT_NE(positive.value(), negative.value());
}

TEST(Fnv1a64, ContinuesAChain) {
  Fnv1a64 second(hash("foo"));
  for (const char c : std::string_view("bar")) second.u8(static_cast<std::uint8_t>(c));
  EXPECT_EQ(second.value(), hash("foobar"));
}

}  // namespace
}  // namespace fencepost::base
