#include "drivers/xbc/decoder.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/drivers/hex.hpp"

namespace fencepost::xbc {
namespace {

// The worked example of our protocol: two blobs, the checksums as printed there.
constexpr std::string_view kExample =
    "$F 1234 2*70\n"
    "$B 0 0 178 146 600 54 160 131 196 160 0*65\n"
    "$B 1 0 40 200 45 64 37 195 43 204 -785*49\n"
    "$E 1234*61\n";

constexpr sensor::Blob kFirst{1, 160, 131, 196, 160, {1'780}, {1'460}, 600, {}};
constexpr sensor::Blob kSecond{2, 37, 195, 43, 204, {400}, {2'000}, 45, {}};

std::string sealed(std::string_view body) {
  unsigned sum = 0;
  for (const char c : body) sum ^= test::octet(c);
  constexpr std::string_view kHex = "0123456789ABCDEF";
  return "$" + std::string(body) + "*" + kHex[sum / 16] + kHex[sum % 16] + "\n";
}

constexpr std::array<std::uint8_t, kChannels> kSignatures = {1, 2, 3};

struct Reading {
  Reading& bytes(std::string_view bytes) {
    for (const char byte : bytes) {
      const Event event = decoder.feed(test::octet(byte), now);
      if (event == Event::kFrame) frames.push_back(decoder.frame());
      if (event == Event::kVersion) versions.push_back(decoder.version());
      ++now.raw;
    }
    return *this;
  }

  Decoder decoder{kSignatures};
  base::Time now{0};
  std::vector<sensor::BlobFrame> frames;
  std::vector<std::int32_t> versions;
};

TEST(XbcDecoder, TheWorkedExample) {
  Reading reading;
  reading.bytes(kExample);
  ASSERT_EQ(reading.frames.size(), 1U);
  const sensor::BlobFrame& frame = reading.frames[0];
  EXPECT_EQ(frame.frame, 1'234U);
  EXPECT_EQ(frame.t.raw, 0) << "the first byte, not the last";
  ASSERT_EQ(frame.blobs.size(), 2U);
  EXPECT_EQ(frame.blobs[0], kFirst);
  EXPECT_EQ(frame.blobs[1], kSecond);
}

TEST(XbcDecoder, TheVersion) {
  EXPECT_EQ(Reading().bytes(sealed("V XBCL 1")).versions, std::vector<std::int32_t>{1});
  EXPECT_EQ(Reading().bytes(sealed("V XBCL 12")).versions, std::vector<std::int32_t>{12});
  for (const std::string_view body : {"V XBCL", "V XBCL x", "V", "V CBC 1", "V XBCL 1 2"}) {
    Reading reading;
    EXPECT_TRUE(reading.bytes(sealed(body)).versions.empty()) << body;
    EXPECT_EQ(reading.decoder.counts().impossible, 1U) << body;
  }
}

TEST(XbcDecoder, NumbersHaveNineDigitsAtMost) {
  EXPECT_EQ(Reading().bytes(sealed("V XBCL 000000001")).versions, std::vector<std::int32_t>{1});
  EXPECT_EQ(Reading().bytes(sealed("V XBCL 999999999")).versions, std::vector<std::int32_t>{999'999'999});
  EXPECT_EQ(Reading().bytes(sealed("V XBCL -7")).versions, std::vector<std::int32_t>{-7});
  for (const std::string_view body :
       {"V XBCL 0000000001", "V XBCL -", "V XBCL --1", "V XBCL  1", "V XBCL 1 ", "V XBCL /", "V XBCL :", "V XBCL 1-"}) {
    Reading reading;
    EXPECT_TRUE(reading.bytes(sealed(body)).versions.empty()) << body;
    EXPECT_EQ(reading.decoder.counts().impossible, 1U) << body;
  }
}

TEST(XbcDecoder, CountsTheFramesThatItGivesUp) {
  Reading reading;
  reading.bytes(sealed("F 1 0")).bytes("$F 2");
  EXPECT_EQ(reading.decoder.counts().incomplete, 0U);
  reading.bytes("$");
  EXPECT_EQ(reading.decoder.counts().damaged, 1U);
  EXPECT_EQ(reading.decoder.counts().incomplete, 1U) << "once";
  reading.bytes("x\n").bytes(sealed("E 1"));
  EXPECT_EQ(reading.decoder.counts().damaged, 2U);
  EXPECT_EQ(reading.decoder.counts().incomplete, 1U);
  EXPECT_TRUE(reading.frames.empty());
  reading.bytes(sealed("F 3 0")).bytes(sealed("E 3")).bytes(sealed("E 3"));
  EXPECT_EQ(reading.frames.size(), 1U) << "it has one end";
}

TEST(XbcDecoder, EitherLineEnd) {
  std::string with_cr;
  for (const char c : kExample) with_cr += c == '\n' ? "\r\n" : std::string(1, c);
  EXPECT_EQ(Reading().bytes(with_cr).frames.size(), 1U);
}

TEST(XbcDecoder, AMissingOrDoubledLineSpoilsItsFrame) {
  const std::string f = sealed("F 7 1");
  const std::string b = sealed("B 0 0 178 146 600 54 160 131 196 160 0");
  const std::string e = sealed("E 7");
  EXPECT_EQ(Reading().bytes(f + b + e).frames.size(), 1U);
  for (const std::string& bytes : {f + e, f + b + b + e, b + e, e, f + f + e, f + b + f + e, f + b + sealed("E 8")}) {
    EXPECT_TRUE(Reading().bytes(bytes).frames.empty()) << bytes;
  }
  EXPECT_EQ(Reading().bytes(f + f + b + e).frames.size(), 1U);
  EXPECT_EQ(Reading().bytes(f + b + sealed("V XBCL 1") + e).frames.size(), 1U) << "an answer may come in between";
  EXPECT_EQ(Reading().bytes("text\n" + f + b + "more text\n" + e).frames.size(), 1U) << "so may what a person prints";
}

TEST(XbcDecoder, RefusesWhatCannotBe) {
  for (const std::string_view body : {"B 3 0 178 146 600 54 160 131 196 160 0",
                                      "B -1 0 178 146 600 54 160 131 196 160 0",
                                      "B 0 32 178 146 600 54 160 131 196 160 0",
                                      "B 0 0 159 146 600 54 160 131 196 160 0",
                                      "B 0 0 178 161 600 54 160 131 196 160 0",
                                      "B 0 0 178 146 0 54 160 131 196 160 0",
                                      "B 0 0 178 146 40000 54 160 131 196 160 0",
                                      "B 0 0 178 146 600 101 160 131 196 160 0",
                                      "B 0 0 178 146 600 54 160 131 356 160 0",
                                      "B 0 0 178 146 600 54 160 131 196 291 0",
                                      "B 0 0 178 146 600 54 160 131 196 160 4000",
                                      "B 0 0 178 146 600 54 160 131 196 160",
                                      "B 0 0 178 146 600 54 160 131 196 160 0 0",
                                      "B 0 0 178  146 600 54 160 131 196 160 0",
                                      "B 0 0 178 146 600 54 160 131 196 160 +0",
                                      "Q 1",
                                      "F x 1",
                                      "F 1",
                                      "F 1 97",
                                      "F -1 0",
                                      "E",
                                      "E 1 2"}) {
    Reading reading;
    reading.bytes(sealed("F 7 1") + sealed(body) + sealed("B 0 0 178 146 600 54 160 131 196 160 0") + sealed("E 7"));
    EXPECT_TRUE(reading.frames.empty()) << body;
    EXPECT_EQ(reading.decoder.counts().impossible, 1U) << body;
  }
}

TEST(XbcDecoder, PixelsAreOursAlready) {
  Reading reading;
  reading.bytes(sealed("F 1 1") + sealed("B 2 31 0 290 32767 100 0 0 355 290 3142") + sealed("E 1"));
  ASSERT_EQ(reading.frames.size(), 1U);
  EXPECT_EQ(reading.frames[0].blobs[0], (sensor::Blob{3, 0, 0, 355, 290, {0}, {2'900}, 0, {}}))
      << "32767 is where the XBC's int ends, not a count";
}

TEST(XbcDecoder, EachValueHasItsRange) {
  for (const std::string_view body :
       {"B 3 0 9 9 9 9 8 8 10 10 0", "B 0 32 9 9 9 9 8 8 10 10 0", "B 0 0 9 9 9 9 10 8 10 10 0",
        "B 0 0 9 9 9 9 8 8 8 10 0", "B 0 0 9 9 9 9 8 10 10 10 0", "B 0 0 9 9 9 9 8 8 10 8 0",
        "B 0 0 9 9 0 9 8 8 10 10 0", "B 0 0 9 9 9 101 8 8 10 10 0", "B 0 0 9 9 9 9 8 8 10 10 3143",
        "B 0 0 9 9 9 9 8 8 10 10 ", "B -1 0 9 9 9 9 8 8 10 10 0", "B 0 0 9 9 9 9 -1 8 10 10 0"}) {
    Reading reading;
    reading.bytes(sealed("F 1 1")).bytes(sealed(body)).bytes(sealed("E 1"));
    EXPECT_TRUE(reading.frames.empty()) << body;
    EXPECT_EQ(reading.decoder.counts().impossible, 1U) << body;
  }
}

}  // namespace
}  // namespace fencepost::xbc
