#include "host/emulate/models/huskylens.hpp"

#include <gtest/gtest.h>

#include "tests/drivers/hex.hpp"

namespace fencepost::emulate {
namespace {

using test::hex;

constexpr base::Time kAwake = base::Time{} + base::milliseconds(1'000);
const Bytes kKnock = hex("55 AA 11 00 2C 3C");
const Bytes kColour = hex("55 AA 11 02 2D 04 00 43");
const Bytes kOk = hex("55 AA 11 00 2E 3E");

Bytes say(HuskyLens& camera, const Bytes& bytes, base::Time now = kAwake) {
  Bytes reply;
  for (const std::uint8_t byte : bytes) {
    for (const std::uint8_t said : camera.take(byte, now)) reply.push_back(said);
  }
  return reply;
}

// The vendor's own example, with its sums computed: 60 x 40 around (160, 120), the eighth image.
TEST(HuskyLensModel, AnswersAsTheDocumentHasIt) {
  HuskyLens camera;
  EXPECT_EQ(say(camera, kKnock), kOk);
  EXPECT_EQ(say(camera, kColour), kOk);
  for (int i = 0; i < 8; ++i) camera.show({{1, 130, 100, 189, 139, {1'595}, {1'195}, 0, {}}});
  const Bytes expected =
      hex("55 AA 11 0A 29 01 00 01 00 08 00 00 00 00 00 4D 55 AA 11 0A 2A A0 00 78 00 3C 00 28 00 01 00 C1");
  EXPECT_EQ(say(camera, hex("55 AA 11 00 21 31")), expected);
  EXPECT_EQ(say(camera, hex("55 AA 11 00 20 30")), expected);
  EXPECT_EQ(say(camera, hex("55 AA 11 02 27 01 00 3A")), expected) << "by its id";
  EXPECT_EQ(say(camera, hex("55 AA 11 02 27 02 00 3B")), hex("55 AA 11 0A 29 00 00 01 00 08 00 00 00 00 00 4C"));
  EXPECT_EQ(say(camera, hex("55 AA 11 00 3C 4C")), hex("55 AA 11 06 3C 05 30 2E 35 2E 31 49"));
}

TEST(HuskyLensModel, SeesNothingBeforeItsAlgorithmIsThatOfColours) {
  HuskyLens camera;
  camera.show({{1, 0, 0, 9, 9, {45}, {45}, 0, {}}});
  EXPECT_EQ(say(camera, hex("55 AA 11 00 21 31")), hex("55 AA 11 0A 29 00 00 01 00 01 00 00 00 00 00 45"));
}

TEST(HuskyLensModel, IsDeafAtFirstAndForgetsItsAlgorithmWithoutPower) {
  HuskyLens camera;
  EXPECT_EQ(say(camera, kKnock, base::Time{} + base::milliseconds(999)), Bytes{});
  EXPECT_EQ(say(camera, kKnock), kOk);
  static_cast<void>(camera.power_up(kAwake));
  EXPECT_EQ(say(camera, kKnock), Bytes{});
}

// The vendor's first example sets no algorithm: the function that it was left in is the one that it starts in.
TEST(HuskyLensModel, StartsInTheFunctionThatItWasLeftIn) {
  HuskyLens camera({}, HuskyLens::kColours);
  static_cast<void>(camera.power_up({}));
  camera.show({{1, 0, 0, 9, 9, {45}, {45}, 0, {}}});
  EXPECT_EQ(say(camera, hex("55 AA 11 00 20 30"))[5], 1);
}

// Its libraries get no arrows, and an OK to commands that change nothing.
TEST(HuskyLensModel, AcknowledgesAndNamesWhatItDoesNotDo) {
  HuskyLens camera({}, HuskyLens::kColours);
  camera.show({{1, 0, 0, 9, 9, {45}, {45}, 0, {}}});
  const Bytes none = hex("55 AA 11 0A 29 00 00 01 00 01 00 00 00 00 00 45");
  EXPECT_EQ(say(camera, hex("55 AA 11 00 22 32")), none);
  EXPECT_EQ(say(camera, hex("55 AA 11 00 25 35")), none);
  EXPECT_TRUE(camera.not_emulated().empty());
  EXPECT_EQ(say(camera, hex("55 AA 11 02 36 01 00 49")), kOk);
  EXPECT_EQ(say(camera, hex("55 AA 11 00 37 47")), kOk);
  EXPECT_EQ(say(camera, hex("55 AA 11 00 30 40")), kOk);
  EXPECT_EQ(say(camera, hex("55 AA 11 00 3B 4B")), Bytes{});
  EXPECT_EQ(say(camera, hex("55 AA 11 00 77 87")), Bytes{});
  EXPECT_EQ(camera.not_emulated(), (std::vector<std::string>{"learn", "forget", "photo", "is pro", "command 77"}));
}

TEST(HuskyLensModel, SaysNothingToWhatIsDamagedOrUnknown) {
  HuskyLens camera;
  EXPECT_EQ(say(camera, hex("55 AA 11 00 2C 3D")), Bytes{});
  EXPECT_EQ(say(camera, hex("55 AA 11 00 77 87")), Bytes{});
  EXPECT_EQ(say(camera, hex("00 55 55 AA FF")), Bytes{});
  EXPECT_EQ(say(camera, kKnock), kOk) << "the next one is heard";
}

TEST(HuskyLensModel, MayBeBusy) {
  HuskyLens camera;
  camera.be_busy(true);
  EXPECT_EQ(say(camera, kKnock), hex("55 AA 11 00 3D 4D"));
}

TEST(HuskyLensModel, IsDescribed) {
  EXPECT_EQ(describe_huskylens(true, kKnock), "knock");
  EXPECT_EQ(describe_huskylens(false, hex("55 AA 11 0A 29 02 00")), "INFO, 2 objects");
  EXPECT_EQ(describe_huskylens(false, hex("01 02")), "");
}

}  // namespace
}  // namespace fencepost::emulate
