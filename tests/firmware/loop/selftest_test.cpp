#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/firmware/loop/desk.hpp"

namespace fencepost::test {
namespace {

using console::Mode;

std::string hex(std::uint64_t value) {
  std::array<char, 40> text{};
  const std::size_t size = console::Sentence(text).digest(value).end();
  return {text.data(), size - 2};
}

template <class Profile>
class Selftest : public testing::Test {};
using Profiles = testing::Types<config::Micro, config::Small, config::Full>;
TYPED_TEST_SUITE(Selftest, Profiles);

// If the reconstruction was changed on purpose, firmware/loop/canned_stream.hpp wants the digest that is shown here.
TYPED_TEST(Selftest, PassesOnThisMachine) {
  Desk<TypeParam> desk;
  EXPECT_EQ(desk.type_line("selftest"), "selftest pass: digest " + hex(loop::kCannedDigest<TypeParam>) + "\r\n");
}

TYPED_TEST(Selftest, FailsIfTheExpectedDigestIsAnother) {
  loop::CannedStream canned = loop::canned_stream<TypeParam>();
  const std::string right = hex(canned.digest);
  canned.digest ^= 1;
  Desk<TypeParam> desk(Mode::kText, {}, canned);
  EXPECT_EQ(desk.type_line("selftest"),
            "selftest FAIL: digest " + right + " instead of " + hex(canned.digest) + "\r\n");
}

TYPED_TEST(Selftest, FailsIfTheReconstructionIsAnother) {
  Desk<TypeParam> desk;
  desk.memory().noise = {};
  desk.memory().noise.heading *= 1.0001F;
  EXPECT_EQ(desk.type_line("selftest").rfind("selftest FAIL: digest ", 0), 0U);
}

TYPED_TEST(Selftest, FailsIfOneBitOfTheStreamIsAnother) {
  std::string lines(loop::kCannedLines);
  const std::size_t at = lines.find("$FPFRM") + 20;
  lines[at] = static_cast<char>(lines[at] ^ 1);  // its CRC is wrong now
  loop::CannedStream canned = loop::canned_stream<TypeParam>();
  std::vector<std::uint8_t> packed(loop::pack_lines(lines, {}));
  ASSERT_FALSE(packed.empty());
  loop::pack_lines(lines, packed);
  canned.packed = packed;
  Desk<TypeParam> desk(Mode::kText, {}, canned);
  EXPECT_EQ(desk.type_line("selftest").rfind("selftest FAIL: digest ", 0), 0U);
}

TYPED_TEST(Selftest, DependsOnNoSettingAndCountsNothing) {
  Desk<TypeParam> desk(Mode::kText, desk_approach(200));
  desk.turn(4100);
  desk.link.take_said();
  desk.type_line("set confirm.k 1");
  desk.type_line("set correct.pose on");
  desk.type_line("set camera.noise 4");
  desk.pipeline().set_signature({1, {0xd0, 0x20, 0x20}, "red", 3, 400});
  const console::Counters before = desk.memory().counters;
  EXPECT_EQ(desk.type_line("selftest").rfind("selftest pass", 0), 0U);
  const console::Counters& after = desk.memory().counters;
  EXPECT_EQ(after.frames, before.frames);
  EXPECT_EQ(after.blobs, before.blobs);
  EXPECT_EQ(after.odometry, before.odometry);
  EXPECT_EQ(after.rejected, before.rejected);
  EXPECT_EQ(desk.memory().map.size(), 0U);  // a new run
  EXPECT_EQ(desk.type_line("get confirm.k").rfind("confirm.k = 1", 0), 0U);
  EXPECT_TRUE(desk.memory().calibration.intrinsics == level_pixy2());
  EXPECT_EQ(desk.type_line("selftest").rfind("selftest pass", 0), 0U);  // as often as you like
}

TEST(SelftestStream, IsTheRecordingThatTheDeskReplays) {
  std::ifstream file(FENCEPOST_SOURCE_DIR "/host/share/recordings/selftest.log", std::ios::binary);
  std::stringstream bytes;
  bytes << file.rdbuf();
  std::string recording = bytes.str();
  std::erase(recording, '\r');
  EXPECT_EQ(recording, loop::kCannedLines);
}

// Sensors go on while the test runs; what they bring is refused and counted, and the log starts anew after it.
TEST(SelftestRun, RefusesInputsWhileItLasts) {
  Desk<config::Micro> desk(Mode::kLog, desk_approach(200));
  desk.turn(2000);
  desk.link.take_said();
  const std::string said = desk.type_line("selftest");
  EXPECT_NE(said.find("selftest pass"), std::string::npos) << said;
  EXPECT_NE(said.find("$FPHDR,1,fencepost"), std::string::npos);
  EXPECT_GT(said.find("$FPHDR"), said.find("selftest pass"));
  EXPECT_GT(desk.memory().counters.refused[static_cast<std::size_t>(console::Refusal::kQueue)], 0U);
  desk.turn(1000);
  EXPECT_GT(desk.memory().map.size(), 0U);
}

}  // namespace
}  // namespace fencepost::test
