// The session, against emulated cameras.
#include "drivers/cmucam/session.hpp"

#include <gtest/gtest.h>

#include "tests/drivers/cmucam/rig.hpp"
#include "tests/drivers/hex.hpp"

namespace fencepost::cmucam {
namespace {

using emulate::CmuCamModel;
using sensor::LinkState;

constexpr base::Duration seconds(std::int64_t s) { return base::milliseconds(1'000 * s); }

struct Member {
  CmuCamModel model;
  const Dialect* dialect;
  bool raw;
  std::string_view version;
};

class EveryCmuCam : public testing::TestWithParam<Member> {};

/// Whose start takes two seconds needs so much longer.
base::Duration start_of(const Member& member) {
  const bool slow = member.model == CmuCamModel::kThree || member.model == CmuCamModel::kFour;
  return slow ? seconds(2) : base::Duration{};
}

TEST_P(EveryCmuCam, FindsBothColoursWithinThreeSecondsOfItsStart) {
  Config config = two_windows(*GetParam().dialect);
  config.raw = GetParam().raw;
  Rig rig(config, GetParam().model);
  EXPECT_EQ(rig.driver.link(), LinkState::kSilent);
  rig.scene = red_and_blue();
  const auto frames =
      rig.run(seconds(3) + start_of(GetParam()) + start_of(GetParam()));  // a CMUcam4 starts anew at our reset
  ASSERT_GE(frames.size(), 8U);
  EXPECT_EQ(rig.driver.link(), LinkState::kOk);
  EXPECT_EQ(rig.driver.session().version(), GetParam().version);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(frames[i].frame, i + 1);
    ASSERT_EQ(frames[i].blobs.size(), 2U);
    const sensor::Blob& red = frames[i].blobs[frames[i].blobs[0].signature == 1 ? 0 : 1];
    const sensor::Blob& blue = frames[i].blobs[frames[i].blobs[0].signature == 1 ? 1 : 0];
    EXPECT_EQ((std::array{red.x1, red.y1, red.x2, red.y2}), (std::array<std::int16_t, 4>{20, 40, 29, 59}));
    EXPECT_EQ((std::array{blue.x1, blue.y1, blue.x2, blue.y2}), (std::array<std::int16_t, 4>{50, 60, 59, 89}));
    EXPECT_EQ(&frames[i].blobs[0], &blue) << "the larger first";
    EXPECT_EQ(red.cx.raw, 240);
    EXPECT_EQ(red.cy.raw, 490);
  }
  EXPECT_EQ(rig.driver.session().counts().implausible, 0U);
  EXPECT_EQ(rig.driver.session().counts().refused, 0U);
  EXPECT_EQ(rig.driver.session().counts().resets, 1U);
}

// So short that no time-out notices: the version text at power-up does.
TEST_P(EveryCmuCam, ComesBackAfterAGlitch) {
  Config config = two_windows(*GetParam().dialect);
  config.raw = GetParam().raw;
  Rig rig(config, GetParam().model);
  rig.scene = red_and_blue();
  ASSERT_FALSE(rig.run(seconds(3)).empty());
  rig.switch_on();
  EXPECT_GE(rig.run(seconds(5) + start_of(GetParam())).size(), 8U);
  EXPECT_EQ(rig.driver.session().counts().resets, 2U);
}

INSTANTIATE_TEST_SUITE_P(All, EveryCmuCam,
                         testing::Values(Member{CmuCamModel::kOne, &kCmuCam1, true, "CMUcam v1.12"},
                                         Member{CmuCamModel::kOne, &kCmuCam1, false, "CMUcam v1.12"},
                                         Member{CmuCamModel::kTwo, &kCmuCam2, true, "CMUcam2 v1.00 c6"},
                                         Member{CmuCamModel::kTwo, &kCmuCam2, false, "CMUcam2 v1.00 c6"},
                                         Member{CmuCamModel::kTwo, &kCmuCam2Ov7620, true, "CMUcam2 v1.00 c6"},
                                         Member{CmuCamModel::kThree, &kCmuCam3, true, "CMUcam2 v1.00 c6"},
                                         Member{CmuCamModel::kThree, &kCmuCam3, false, "CMUcam2 v1.00 c6"},
                                         Member{CmuCamModel::kThree, &kCmuCam3High, true, "CMUcam2 v1.00 c6"},
                                         Member{CmuCamModel::kFour, &kCmuCam4, true, "CMUcam4 v1.02"}));

/// The TC that a camera of that kind is sent, by one that agrees to everything.
std::string window_sent(const Dialect& dialect, const ColourWindow& window) {
  Config config;
  config.dialect = &dialect;
  config.settle = {};
  (void)config.windows.push_back(window);
  Session session(config);
  const std::string banner = std::string(dialect.banner) + "1.00\r:";
  base::Time now;
  for (int turn = 0; turn < 50; ++turn) {
    session.step(now = now + base::milliseconds(1));
    const auto waiting = session.outbox().waiting();
    const std::string sent(waiting.begin(), waiting.end());
    session.outbox().sent(waiting.size());
    if (sent.starts_with("TC ")) return sent;
    const bool text = sent.find("RS") != std::string::npos || sent.find("GV") != std::string::npos;
    for (const char byte : sent.empty() ? std::string() : "ACK\r" + (text ? banner : std::string(":")))
      (void)session.take(test::octet(byte), now);
  }
  return "nothing";
}

// A saturated red is 255 to a CMUcam4 and 240 to its elders.
TEST(CmuCamSession, BoundsAreThoseOfTheImager) {
  const ColourWindow red = {1, 215, 255, 0, 40, 0, 40};
  EXPECT_EQ(window_sent(kCmuCam4, red), "TC 215 255 0 40 0 40\r");
  EXPECT_EQ(window_sent(kCmuCam1, red), "TC 215 240 16 40 16 40\r");
  EXPECT_EQ(window_sent(kCmuCam4, {1, 0, 9, 10, 99, 100, 255}), "TC 0 9 10 99 100 255\r");
  EXPECT_EQ(window_sent(kCmuCam4, {1, 50, 50, 60, 60, 70, 70}), "TC 50 50 60 60 70 70\r") << "a single shade";
  EXPECT_EQ(window_sent(kCmuCam2, red), "TC 215 240 16 40 16 40\r");
  EXPECT_EQ(window_sent(kCmuCam3, red), "TC 215 240 16 40 16 40\r");
}

TEST(CmuCamSession, SaysWhatItIsToldTo) {
  Config config = two_windows(kCmuCam1);
  config.settle = {};
  Session session(config);
  std::string sent;
  base::Time now{0};
  const auto hear = [&](std::string_view bytes) {
    now.raw += 10;
    for (const char byte : bytes) (void)session.take(test::octet(byte), now);
    session.step(now);
    const auto waiting = session.outbox().waiting();
    sent.assign(waiting.begin(), waiting.end());
    session.outbox().sent(waiting.size());
    return sent;
  };
  EXPECT_EQ(hear(""), "\rRS\r");
  EXPECT_EQ(hear(":ACK\r"), "");
  EXPECT_EQ(hear("\rCMUcam v1.12\r:"), "\rGV\r");
  EXPECT_EQ(hear(":ACK\rCMUcam v1.12\r:"), "CR 18 44 19 33\r");
  EXPECT_EQ(hear("ACK\r:"), "CR 18 40 19 32\r");
  EXPECT_EQ(hear("ACK\r:"), "PM 1\r");
  EXPECT_EQ(hear("NCK\r:"), "PM 1\r") << "damaged on the way: again";
  EXPECT_EQ(hear("ACK\r:"), "RM 1\r");
  EXPECT_EQ(hear("ACK\r:"), "TC 180 240 16 60 16 60\r");
  EXPECT_EQ(hear("ACK\r" + test::hex_text("FF 4D 2D 47 28 3C 32 50 14 80") + ":"), "TC 16 60 16 60 180 240\r");
  EXPECT_EQ(hear("ACK\r" + test::hex_text("FF 4D 00 00 00 00 00 00 00 00") + ":"), "TC 180 240 16 60 16 60\r");
  EXPECT_EQ(session.sample().blobs.size(), 1U);
  EXPECT_EQ(session.counts().frames, 1U);
}

// A second for its version text, half of one for an ACK, a fifth for a packet.
TEST(CmuCamSession, WaitsAsLongAsItsDialectSays) {
  Config config = two_windows(kCmuCam1);
  config.settle = base::milliseconds(300);
  Session session(config);
  base::Time now{0};
  const auto says = [&](std::int64_t ms, std::string_view heard = "") {
    for (const char byte : heard) (void)session.take(test::octet(byte), now);
    now = now + base::milliseconds(ms);
    session.step(now);
    const auto waiting = session.outbox().waiting();
    std::string sent(waiting.begin(), waiting.end());
    session.outbox().sent(waiting.size());
    return sent;
  };
  EXPECT_EQ(says(0), "\rRS\r");
  EXPECT_EQ(says(999), "");
  EXPECT_EQ(says(1).size(), 18U + 4U) << "the way out of raw input too, every other time";
  EXPECT_EQ(says(0, ":ACK\r\rCMUcam v1.12\r:"), "\rGV\r");
  EXPECT_EQ(says(499), "");
  EXPECT_EQ(says(1), "\rGV\r");
  EXPECT_EQ(says(0, "ACK\rCMUcam v1.12\r:"), "CR 18 44 19 33\r");
  EXPECT_EQ(says(0, "ACK\r:"), "") << "white balance settles";
  EXPECT_EQ(says(299), "");
  EXPECT_EQ(says(1), "CR 18 40 19 32\r");
  EXPECT_EQ(says(499), "");
  EXPECT_EQ(says(1), "\rGV\r") << "lost on its way";
  EXPECT_EQ(says(0, "ACK\rCMUcam v1.12\r:"), "CR 18 40 19 32\r");
  EXPECT_EQ(says(0, "ACK\r:"), "PM 1\r");
  EXPECT_EQ(says(0, "ACK\r:"), "RM 1\r");
  EXPECT_EQ(says(0, "ACK\r:"), "TC 180 240 16 60 16 60\r");
  EXPECT_EQ(says(199), "");
  EXPECT_EQ(says(1), "\rGV\r");
  EXPECT_EQ(session.counts().unanswered, 1U);
  EXPECT_EQ(says(0, "ACK\rCMUcam v1.12\r:"), "TC 180 240 16 60 16 60\r");
  EXPECT_EQ(session.counts().resets, 1U);
}

/// A session that tracks two windows; what it says to what it hears.
struct Tracking {
  Tracking() {
    session.step(now);
    for (const char* answer :
         {":ACK\r\rCMUcam v1.12\r:", ":ACK\rCMUcam v1.12\r:", "ACK\r:", "ACK\r:", "ACK\r:", "ACK\r:"})
      hear(answer);
    EXPECT_EQ(sent, kRed);
  }
  const std::string& hear(std::string_view bytes, std::int64_t ms = 1) {
    session.outbox().sent(session.outbox().waiting().size());
    now = now + base::milliseconds(ms);
    for (const char byte : bytes) (void)session.take(test::octet(byte), now);
    session.step(now);
    const auto waiting = session.outbox().waiting();
    sent.assign(waiting.begin(), waiting.end());
    return sent;
  }
  static Config config() {
    Config config = two_windows(kCmuCam1);
    config.settle = {};
    return config;
  }
  inline static const std::string kRed = "TC 180 240 16 60 16 60\r";
  inline static const std::string kBlue = "TC 16 60 16 60 180 240\r";
  inline static const std::string kPacket = "ACK\r" + test::hex_text("FF 4D 2D 47 28 3C 32 50 14 80") + ":";
  Session session{config()};
  base::Time now{0};
  std::string sent;
};

TEST(CmuCamSession, AskedInVainItAsksAgain) {
  Tracking refused;
  EXPECT_EQ(refused.hear("NCK\r:"), Tracking::kRed);
  EXPECT_EQ(refused.session.counts().refused, 1U);
  EXPECT_EQ(refused.session.counts().unanswered, 0U);
  EXPECT_EQ(refused.hear("ACK\r:"), Tracking::kRed);
  EXPECT_EQ(refused.session.counts().refused, 1U);
  EXPECT_EQ(refused.session.counts().unanswered, 1U);
  EXPECT_EQ(refused.hear(":"), "") << "the prompt of something else";
}

TEST(CmuCamSession, AfterATimeOutItBeginsWithTheFirstWindow) {
  Tracking lost;
  EXPECT_EQ(lost.hear(Tracking::kPacket), Tracking::kBlue);
  EXPECT_EQ(lost.hear("", 200), "\rGV\r");
  EXPECT_EQ(lost.hear("ACK\rCMUcam v1.12\r:"), Tracking::kRed);
  EXPECT_EQ(lost.session.counts().frames, 0U);
}

// It has just been switched on: it says its version unasked, and its set-up is gone.
TEST(CmuCamSession, AVersionUnaskedIsACameraThatStarted) {
  Tracking started;
  EXPECT_EQ(started.hear("CMUcam v1.12\r:"), "\rGV\r");
  EXPECT_EQ(started.session.counts().resets, 2U);
  EXPECT_EQ(started.session.link(), LinkState::kUnready);
  EXPECT_EQ(started.hear("ACK\rCMUcam v1.12\r:"), "CR 18 44 19 33\r") << "from the beginning";
}

// Two lost answers, one that comes, two lost again: it is heard of.
TEST(CmuCamSession, ThreeLostAnswersInARowAreSilence) {
  Tracking heard;
  for (int i = 0; i < 2; ++i) {
    heard.hear("", 200);
    heard.hear("", 500);
    EXPECT_NE(heard.session.link(), LinkState::kSilent) << i;
    heard.hear("ACK\rCMUcam v1.12\r:");
    EXPECT_EQ(heard.sent, Tracking::kRed) << i;
  }
  heard.hear("", 200);
  heard.hear("", 500);
  EXPECT_NE(heard.session.link(), LinkState::kSilent);
  heard.hear("", 500);
  EXPECT_EQ(heard.session.link(), LinkState::kSilent);
}

TEST(CmuCamSession, TriesTheWayOutOfRawInputToo) {
  const Config config = two_windows(kCmuCam1);
  Rig rig(config, CmuCamModel::kOne);
  (void)rig.device.feed("RM 7\r");  // another program's settings
  rig.scene = red_and_blue();
  EXPECT_GE(rig.run(seconds(6)).size(), 8U);
}

TEST(CmuCamSession, TimeIsTheFirstBytesOfTheFirstPacket) {
  Config config = two_windows(kCmuCam1);
  Rig rig(config, CmuCamModel::kOne);
  rig.scene = red_and_blue();
  std::optional<sensor::BlobFrame> frame;
  while (!frame) frame = rig.step();
  // Frames come with steps that are multiples of 30, the second window's one image after the first's.
  EXPECT_EQ(frame->t.raw % (Rig::kImage.raw), 0);
  EXPECT_EQ((rig.clock.now() - frame->t).raw, Rig::kImage.raw);
}

TEST(CmuCamSession, LinkStates) {
  Config config = two_windows(kCmuCam3);
  Rig rig(config, CmuCamModel::kThree);
  rig.switch_off();
  EXPECT_EQ(rig.driver.link(), LinkState::kSilent);
  rig.switch_on();
  (void)rig.run(base::milliseconds(2'300));
  EXPECT_EQ(rig.driver.link(), LinkState::kUnready) << "white balance is settling";
  const auto empty = rig.run(seconds(3));
  ASSERT_FALSE(empty.empty());
  EXPECT_TRUE(empty.back().blobs.empty());
  EXPECT_EQ(rig.driver.link(), LinkState::kEmpty);
  rig.scene = red_and_blue();
  (void)rig.run(seconds(1));
  EXPECT_EQ(rig.driver.link(), LinkState::kOk);
  rig.link.unplug();
  (void)rig.run(base::milliseconds(20));
  EXPECT_EQ(rig.driver.link(), LinkState::kAbsent);
  rig.link.replug();
  (void)rig.run(base::milliseconds(20));
  EXPECT_NE(rig.driver.link(), LinkState::kAbsent);
  EXPECT_GE(rig.run(seconds(3)).size(), 8U);
}

TEST(CmuCamSession, WithoutAGoodWindowItIsNeverReady) {
  Config none = two_windows(kCmuCam3);
  none.windows.clear();
  Config swapped = two_windows(kCmuCam3);
  swapped.windows[0].red_min = 241;
  for (const Config& config : {none, swapped}) {
    Rig rig(config, CmuCamModel::kThree);
    rig.scene = red_and_blue();
    EXPECT_TRUE(rig.run(seconds(10)).empty());
    EXPECT_EQ(rig.driver.link(), LinkState::kUnready);
    rig.switch_off();
    (void)rig.run(seconds(10));
    EXPECT_EQ(rig.driver.link(), LinkState::kSilent);
  }
}

TEST(CmuCamSession, AnotherModelIsNotReady) {
  Rig rig(two_windows(kCmuCam1), CmuCamModel::kThree);
  rig.scene = red_and_blue();
  EXPECT_TRUE(rig.run(seconds(10)).empty());
  EXPECT_EQ(rig.driver.link(), LinkState::kUnready);
}

}  // namespace
}  // namespace fencepost::cmucam
