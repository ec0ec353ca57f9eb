// The session with emulated Creates, and an hour of it with damaged bytes.
#include "drivers/create/session.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "hal/fake/scripted_link.hpp"
#include "tests/drivers/bench/create_rig.hpp"
#include "tests/drivers/hex.hpp"

namespace fencepost::create {
namespace {

using emulate::CreateDevice;
using emulate::CreateModel;
using sensor::LinkState;

Config config_of(Model model, Mode mode = Mode::kPassive) {
  Config config;
  config.model = model;
  config.mode = mode;
  return config;
}

using Rig = test::Bench<test::CreateRig>;

std::string sent_by(const Config& config) {
  fake::ScriptedLink<64> link({});
  Create<fake::ScriptedLink<64>> driver(link, config);
  (void)driver.poll({10});
  return {link.written().begin(), link.written().end()};
}

TEST(CreateSession, StartsAsTheOpenInterfaceSays) {
  EXPECT_EQ(sent_by(config_of(Model::kCreate2)), test::hex_text("80 94 02 2B 2C"));
  EXPECT_EQ(sent_by(config_of(Model::kCreate1)), test::hex_text("80 94 04 13 14 2A 29"));
  EXPECT_EQ(sent_by(config_of(Model::kCreate2, Mode::kSafe)), test::hex_text("80 83 94 02 2B 2C"));
  EXPECT_EQ(sent_by(config_of(Model::kCreate2, Mode::kFull)), test::hex_text("80 84 94 02 2B 2C"));
}

// 10 counts a frame of 15 ms each: 0.4445650 mm, 667 counts a second. Under both checksum rules.
TEST(CreateSession, DrivesStraight) {
  for (const bool header : {false, true}) {
    Rig rig(config_of(Model::kCreate2), CreateModel::kTwo, header);
    EXPECT_EQ(rig.driver.link(), LinkState::kSilent);
    rig.run(100);
    EXPECT_EQ(rig.driver.link(), LinkState::kOk);
    rig.left_a_frame = rig.right_a_frame = 10;
    rig.run(1'500);
    rig.stand();
    rig.run(30);
    EXPECT_EQ(rig.last.x.raw, 4'446) << "1000 counts are 444.565 mm";
    EXPECT_EQ(rig.last.y.raw, 0);
    EXPECT_EQ(rig.driver.session().decoder().rule(), header ? ChecksumRule::kWithHeader : ChecksumRule::kWithoutHeader);
  }
}

// Right wheel forward, left back, by 4 counts a frame, 208 frames: 2 * 832 * 0.444565 / 235 = 3.1479 rad. That is a
// little more than half a turn: -3.1353.
TEST(CreateSession, TurnsOnTheSpot) {
  Rig rig(config_of(Model::kCreate2), CreateModel::kTwo);
  rig.run(90);
  rig.left_a_frame = -4;
  rig.right_a_frame = 4;
  rig.run(3'120);
  rig.stand();
  rig.run(30);
  EXPECT_EQ(rig.last.x.raw, 0);
  EXPECT_EQ(rig.last.y.raw, 0);
  EXPECT_NEAR(rig.last.heading.raw, -31'353, 1);
}

Config create1() {
  Config config = config_of(Model::kCreate1);
  config.wheels = odometry::kCreate1Wheels;
  return config;
}

// A reading, 0 mm and 0 degrees at 100 mm/s, then requested speeds alone, left 100, right 90. After 15 ms 1.5 mm and,
// on the mean of both, -0.075 mm / 258 mm = -0.00029 rad. Checksums without the header.
TEST(CreateSession, ACreate1IsReadSeldom) {
  const auto reading = test::bytes_of(test::hex_text("13 0C 13 00 00 14 00 00 2A 00 64 29 00 64 B2"));
  const auto requested = test::bytes_of(test::hex_text("13 06 2A 00 64 29 00 5A E9"));
  const std::array<fake::LinkStep, 3> script = {{{{}, base::Error::kNotReady}, {reading, {}}, {requested, {}}}};
  fake::ScriptedLink<64> link(script);
  Create<fake::ScriptedLink<64>> driver(link, create1());
  EXPECT_FALSE(driver.poll({0}));
  EXPECT_EQ(*driver.poll({100}), (sensor::OdometrySample{{100}, {}, {}, {}}));
  const auto moved = driver.poll({250});
  ASSERT_TRUE(moved);
  EXPECT_EQ(moved->x.raw, 15);
  EXPECT_EQ(moved->heading.raw, -3);
  EXPECT_EQ(std::string(link.written().begin(), link.written().end()),
            test::hex_text("80 94 04 13 14 2A 29 94 02 2A 29"));
}

/// Drives for so long as requested, mm/s, its wheels turning `share` of that.
void drive(Rig& rig, int left, int right, int ms, double share = 1) {
  rig.device.request(left, right);
  rig.mm_a_frame = share * (left + right) / 2.0 * 0.015;
  rig.degrees_a_frame = share * (right - left) * 0.015 / 258 * 180 / std::numbers::pi;
  rig.run(ms);
}

double degrees(const sensor::OdometrySample& sample) { return sample.heading.to_double() * 180 / std::numbers::pi; }

// 0.073 degrees a frame, of which no frame's reading would tell anything: 90 degrees in 18.4 s.
TEST(CreateSession, ACreate1sSlowTurnsAreKept) {
  Rig rig(create1(), CreateModel::kOne);
  rig.device.move(500, 90);  // before anybody listened
  rig.run(90);
  EXPECT_EQ(rig.last.x.raw, 0) << "the first reading covers an unknown time";
  EXPECT_EQ(rig.last.heading.raw, 0);
  drive(rig, -11, 11, 18'424);
  drive(rig, 0, 0, 1'500);
  EXPECT_NEAR(degrees(rig.last), 90, 0.2);
  drive(rig, 200, 200, 5'000);
  drive(rig, 0, 0, 1'500);
  EXPECT_NEAR(rig.last.x.to_double(), 0, 0.005);
  EXPECT_NEAR(rig.last.y.to_double(), 1, 0.005);
  EXPECT_EQ(rig.driver.session().requested().surprises(), 0U);
}

// Ten turns with wheels 5 % slower than requested: without readings the heading would be 180 degrees off.
TEST(CreateSession, ACreate1sReadingsCorrectWhatWasRequested) {
  Rig rig(create1(), CreateModel::kOne);
  rig.run(90);
  drive(rig, -100, 100, 85'300, 0.95);
  drive(rig, 0, 0, 1'500);
  const double turned = 200 * 0.95 * 85.3 / 258 * 180 / std::numbers::pi;
  EXPECT_NEAR(std::remainder(degrees(rig.last) - turned, 360), 0, 10) << "0.3 % of 3599 degrees";
}

TEST(CreateSession, ACreate1ThatStallsStands) {
  Rig rig(create1(), CreateModel::kOne);
  rig.run(90);
  drive(rig, 200, 200, 10'000, 0);
  EXPECT_LT(rig.last.x.to_double(), 0.06) << "the 0.25 s until the next reading, at most";
  drive(rig, 0, 0, 1'500);
  EXPECT_NEAR(rig.last.x.to_double(), 0, 0.002);
  EXPECT_GT(rig.driver.session().requested().surprises(), 10U);
}

// Nothing is requested: 45 degrees/s and 200 mm/s are found by the readings alone.
TEST(CreateSession, ACreate1ThatIsPushedIsReadMoreOften) {
  Rig rig(create1(), CreateModel::kOne);
  rig.run(90);
  rig.mm_a_frame = 3;
  rig.run(1'500);
  rig.mm_a_frame = 0;
  rig.degrees_a_frame = 0.675;
  rig.run(1'995);
  rig.degrees_a_frame = 0;
  rig.mm_a_frame = -3;
  rig.run(1'500);
  rig.stand();
  rig.run(1'500);
  EXPECT_NEAR(rig.last.x.to_double(), 0.3, 0.02);
  EXPECT_NEAR(rig.last.y.to_double(), -0.3, 0.02);
  EXPECT_NEAR(degrees(rig.last), 90, 3);
}

TEST(CreateSession, ACreate1ThatWasSwitchedOffGoesOnFromWhereItWas) {
  Rig rig(create1(), CreateModel::kOne);
  rig.run(90);
  drive(rig, 200, 200, 2'400);
  const base::Metres before = rig.last.x;
  rig.link.power(false);
  rig.run(3'000);
  (void)rig.device.power_up();
  rig.stand();
  rig.link.power(true);
  rig.run(1'200);
  EXPECT_EQ(rig.driver.link(), LinkState::kOk);
  EXPECT_NEAR(rig.last.x.to_double(), before.to_double(), 0.02) << "0.1 s as requested";
}

TEST(CreateSession, ARobotThatWasSwitchedOffGoesOnFromWhereItWas) {
  Rig rig(config_of(Model::kCreate2, Mode::kSafe), CreateModel::kTwo);
  rig.left_a_frame = rig.right_a_frame = 10;
  rig.run(1'500);
  rig.stand();
  rig.run(30);
  const base::Metres before = rig.last.x;
  EXPECT_GT(before.raw, 4'000);
  rig.link.power(false);
  rig.run(3'000);
  EXPECT_EQ(rig.driver.link(), LinkState::kSilent);
  (void)rig.device.power_up();
  rig.link.power(true);
  rig.run(1'200);
  EXPECT_EQ(rig.driver.link(), LinkState::kOk);
  EXPECT_EQ(rig.device.mode(), 2) << "in its mode again";
  EXPECT_EQ(rig.last.x, before) << "its counts began at zero, the robot did not move";
  rig.left_a_frame = rig.right_a_frame = 10;
  rig.run(1'500);
  EXPECT_GT(rig.last.x.raw, before.raw + 4'000);
}

// The counts ran on while nobody listened: nothing is lost.
TEST(CreateSession, AShortUnplugCostsNoMotion) {
  Rig rig(config_of(Model::kCreate2), CreateModel::kTwo);
  rig.run(90);
  rig.left_a_frame = rig.right_a_frame = 10;
  rig.run(3'000);
  rig.link.unplug();
  rig.run(300);
  EXPECT_EQ(rig.driver.link(), LinkState::kAbsent);
  rig.link.replug();
  rig.run(3'000);
  rig.stand();
  rig.run(30);
  EXPECT_EQ(rig.last.x.raw, 18'672) << "4200 counts";
}

// A robot that somebody drives is not taken out of its mode by a stream that fell silent.
TEST(CreateSession, AsksForTheStreamBeforeItStartsAnew) {
  Rig rig(config_of(Model::kCreate2), CreateModel::kTwo);
  rig.run(300);
  (void)rig.device.feed(test::hex_text("84 96 00"));  // full mode, stream paused
  rig.run(450);
  EXPECT_EQ(rig.driver.link(), LinkState::kOk);
  rig.run(600);
  EXPECT_EQ(rig.driver.link(), LinkState::kOk);
  EXPECT_EQ(rig.device.mode(), 3);
  EXPECT_EQ(rig.driver.session().counts().starts, 2U);
}

// A damaged count: the robot waits for a list of 255 packets, and takes what it is asked for its entries.
TEST(CreateSession, ARobotThatWaitsForALongListIsGivenIt) {
  Rig rig(config_of(Model::kCreate2), CreateModel::kTwo);
  rig.run(300);
  (void)rig.device.feed(test::hex_text("96 00 94 FF"));  // the stream paused, a list begun
  rig.run(10'000);
  EXPECT_EQ(rig.driver.link(), LinkState::kOk);
}

TEST(CreateSession, CarriesCommandsOfWhoeverDrives) {
  fake::ScriptedLink<64> link({});
  Create<fake::ScriptedLink<64>> driver(link, config_of(Model::kCreate2, Mode::kFull));
  (void)driver.poll({10});
  EXPECT_TRUE(driver.session().command(test::bytes_of(test::hex_text("91 00 64 00 64"))));
  EXPECT_FALSE(driver.session().command(std::vector<std::uint8_t>(9))) << "too long";
  (void)driver.poll({20});
  const std::string sent(link.written().begin(), link.written().end());
  EXPECT_EQ(sent, test::hex_text("80 84 94 02 2B 2C 91 00 64 00 64"));
}

/// A session after its start, with a robot that streams: it sends the commands alone.
class Driven : public ::testing::Test {
 protected:
  explicit Driven(Mode mode = Mode::kSafe) : rig(config_of(Model::kCreate2, mode), CreateModel::kTwo) { rig.run(100); }
  Session& session() { return rig.driver.session(); }
  [[nodiscard]] CreateDevice::Speeds speeds() const { return rig.device.speeds(); }
  Rig rig;
};

/// Bytes of the Open Interface's specification: opcode 137, velocity and radius with the high byte first.
TEST(CreateDrive, IsSentAsTheOpenInterfaceSays) {
  const std::pair<Motion, const char*> kBytes[] = {
      {{200, Motion::kStraight}, "89 00 C8 7F FF"},
      {{-200, 500}, "89 FF 38 01 F4"},  // the specification's example: backwards, turning left
      {{100, Motion::kOnTheSpotLeft}, "89 00 64 00 01"},
      {{100, Motion::kOnTheSpotRight}, "89 00 64 FF FF"},
      {{500, -2'000}, "89 01 F4 F8 30"},
  };
  const auto frame = test::bytes_of(test::hex_text("13 06 2B 00 00 2C 00 00 A3"));
  for (const auto& [motion, bytes] : kBytes) {
    const std::array<fake::LinkStep, 2> script = {{{{}, base::Error::kNotReady}, {frame, {}}}};
    fake::ScriptedLink<64> link(script);
    Create<fake::ScriptedLink<64>> driver(link, config_of(Model::kCreate2, Mode::kSafe));
    driver.session().drive(motion);
    driver.session().allow_motion(true);
    for (std::int64_t t = 0; t <= 20; t += 5) (void)driver.poll({t});
    const std::string sent(link.written().begin(), link.written().end());
    EXPECT_TRUE(sent.ends_with(test::hex_text(bytes))) << bytes;
  }
}

TEST_F(Driven, NothingMovesItUnlessAskedFor) {
  session().allow_motion(true);
  rig.run(3'000);
  EXPECT_FALSE(rig.device.driven());
  EXPECT_EQ(rig.device.mode(), 2) << "safe, for whoever drives it otherwise";
}

TEST_F(Driven, DrivesOnlyWhileItMay) {
  session().drive({200, Motion::kStraight});
  rig.run(200);
  EXPECT_EQ(speeds(), (CreateDevice::Speeds{0, 0})) << "not yet allowed";
  session().allow_motion(true);
  rig.run(20);
  EXPECT_EQ(speeds(), (CreateDevice::Speeds{200, 200}));
  session().allow_motion(false);
  rig.driver.push(rig.clock.now());
  rig.run(2);
  EXPECT_EQ(speeds(), (CreateDevice::Speeds{0, 0}));
  session().allow_motion(true);
  session().drive({200, Motion::kOnTheSpotLeft});
  rig.run(20);
  EXPECT_EQ(speeds(), (CreateDevice::Speeds{-200, 200}));
}

TEST_F(Driven, IsNoFasterThanItMay) {
  session().drive({200, Motion::kStraight});
  session().allow_motion(true, 120);
  rig.run(20);
  EXPECT_EQ(speeds(), (CreateDevice::Speeds{120, 120}));
  session().allow_motion(true, 300);
  rig.run(20);
  EXPECT_EQ(speeds(), (CreateDevice::Speeds{200, 200})) << "and no faster than it is asked to";
  session().drive({-200, Motion::kStraight});
  session().allow_motion(true, 120);
  rig.run(20);
  EXPECT_EQ(speeds(), (CreateDevice::Speeds{-120, -120}));
  session().drive({200, Motion::kOnTheSpotLeft});
  rig.run(20);
  EXPECT_EQ(speeds(), (CreateDevice::Speeds{-200, 200})) << "on the spot its middle stands";
  session().drive({200, Motion::kStraight});
  session().allow_motion(true, 0);
  rig.run(20);
  EXPECT_EQ(speeds(), (CreateDevice::Speeds{0, 0}));
}

// Every 100 ms, and at once when it changes.
TEST(CreateDrive, IsSentTenTimesASecond) {
  Session session(config_of(Model::kCreate2, Mode::kSafe));
  const auto frame = test::bytes_of(test::hex_text("13 06 2B 00 00 2C 00 00 A3"));
  const auto commands = [&](std::int64_t from_ms, std::int64_t to_ms) {
    std::size_t sent = 0;
    for (std::int64_t ms = from_ms; ms < to_ms; ++ms) {
      const base::Time now{10 * ms};
      if (ms % 15 == 0) {
        for (const std::uint8_t byte : frame) (void)session.take(byte, now);
      }
      session.step(now);
      const auto waiting = session.outbox().waiting();
      for (std::size_t i = 0; i + 5 <= waiting.size(); ++i) sent += waiting[i] == 0x89 ? 1U : 0U;
      session.outbox().sent(waiting.size());
    }
    return sent;
  };
  EXPECT_EQ(commands(0, 300), 0U);
  session.drive({200, Motion::kStraight});
  session.allow_motion(true);
  EXPECT_EQ(commands(300, 1'300), 10U);
  session.drive({100, Motion::kStraight});
  EXPECT_EQ(commands(1'300, 1'301), 1U);
  EXPECT_EQ(commands(1'301, 1'400), 0U);
  EXPECT_EQ(commands(1'400, 1'401), 1U);
}

TEST(CreateSession, AFrameFromBeforeTheLatestIsPassedOver) {
  Session session(config_of(Model::kCreate2));
  const auto hear = [&](const char* frame, std::int64_t t) {
    bool complete = false;
    for (const std::uint8_t byte : test::bytes_of(test::hex_text(frame)))
      complete = session.take(byte, {t}) || complete;
    return complete;
  };
  EXPECT_TRUE(hear("13 06 2B 00 00 2C 00 00 A3", 1'000));
  EXPECT_FALSE(hear("13 06 2B 00 0A 2C 00 0A 8F", 900));
  EXPECT_EQ(session.sample().t, base::Time{1'000});
  EXPECT_TRUE(hear("13 06 2B 00 0A 2C 00 0A 8F", 1'150));
  EXPECT_EQ(session.sample().x.raw, 44) << "10 counts";
}

// A second after the last reading, and then every 100 ms until one comes.
TEST(CreateSession, ACreate1IsAskedForAReadingWhenItIsDue) {
  Session session(create1());
  const auto asked = [&](std::int64_t ms) {
    session.step({10 * ms});
    const auto waiting = session.outbox().waiting();
    const bool asks = waiting.size() >= 6 && waiting[waiting.size() - 6] == 0x94 && waiting[waiting.size() - 5] == 4;
    session.outbox().sent(waiting.size());
    return asks;
  };
  EXPECT_TRUE(asked(0));
  for (const std::uint8_t byte : test::hex("13 0C 13 00 00 14 00 00 2A 00 00 29 00 00 7A"))
    (void)session.take(byte, {1'000});
  const auto requested = test::hex("13 06 2A 00 00 29 00 00 A7");
  std::vector<std::int64_t> times;
  for (std::int64_t ms = 101; ms < 1'450; ++ms) {
    if (ms % 15 == 0) {
      for (const std::uint8_t byte : requested) (void)session.take(byte, {10 * ms});
    }
    if (asked(ms)) times.push_back(ms);
  }
  EXPECT_EQ(times, (std::vector<std::int64_t>{1'100, 1'200, 1'300, 1'400}));
}

/// Hears a reading of a Create 1: the distance since the one before, mm, and the speed that is requested of both
/// wheels, mm/s.
void hear_reading(Session& session, int distance, std::uint8_t requested, std::int64_t t) {
  std::vector<std::uint8_t> bytes = test::hex("13 0C 13 00 00 14 00 00 2A 00 00 29 00 00");
  bytes[3] = static_cast<std::uint8_t>(static_cast<unsigned>(distance) >> 8U & 0xFFU);
  bytes[4] = static_cast<std::uint8_t>(static_cast<unsigned>(distance) & 0xFFU);
  bytes[10] = bytes[13] = requested;
  unsigned sum = 0;
  for (const std::uint8_t byte : bytes) sum += byte;
  bytes.push_back(static_cast<std::uint8_t>(0x100U - (sum & 0xFFU)));
  for (const std::uint8_t byte : bytes) (void)session.take(byte, {t});
}

// The motion predicted before an impossible reading is kept; the next one begins there.
TEST(CreateSession, AnImpossibleReadingIsPassedOver) {
  Session session(create1());
  hear_reading(session, 0, 100, 1'000);
  hear_reading(session, 500, 100, 2'000);
  EXPECT_EQ(session.counts().impossible, 1U);
  EXPECT_EQ(session.sample().x.raw, 100) << "0.1 s at 100 mm/s";
  hear_reading(session, 10, 100, 3'000);
  EXPECT_EQ(session.sample().x.raw, 200);
  EXPECT_EQ(session.requested().surprises(), 0U);
}

TEST(CreateSession, IsHeardForHalfASecond) {
  Session session(config_of(Model::kCreate2));
  session.step({0});
  for (const std::uint8_t byte : test::bytes_of(test::hex_text("13 06 2B 00 00 2C 00 00 A3")))
    (void)session.take(byte, {0});
  session.step({4'999});
  EXPECT_EQ(session.link(), LinkState::kOk);
  session.step({5'000});
  EXPECT_EQ(session.link(), LinkState::kUnready) << "no frame";
  session.step({5'001});
  EXPECT_EQ(session.link(), LinkState::kSilent);
  EXPECT_EQ(session.counts().starts, 2U);
}

// A reading after 0.9 s of a Create 1, whose wheels do 600 mm/s. The limit is 600 mm with the lateness of 0.1 s, and
// one for rounding.
TEST(CreateSession, ACreate1sReadingIsNoFurtherThanItsWheelsCanTurn) {
  for (const int sign : {1, -1}) {
    for (const auto& [mm, impossible] : {std::pair(601, 0U), {602, 1U}}) {
      Session session(create1());
      hear_reading(session, 5'000, 0, 1'000);
      EXPECT_EQ(session.sample().x.raw, 0) << "the first one covers an unknown time";
      hear_reading(session, sign * mm, 0, 10'000);
      EXPECT_EQ(session.counts().impossible, impossible) << sign * mm;
      EXPECT_EQ(session.sample().x.raw, impossible == 0 ? sign * (10 * mm + 5) : 0) << sign * mm;
    }
  }
}

TEST_F(Driven, ACommandThatWasLostIsSentAgain) {
  session().drive({200, Motion::kStraight});
  session().allow_motion(true);
  rig.run(20);
  (void)rig.device.feed(test::hex_text("89 00 64 7F FF"));  // as if ours had been damaged
  EXPECT_EQ(speeds().left, 100);
  rig.run(130);
  EXPECT_EQ(speeds().left, 200);
}

// Counts that do not come are motion that nobody knows.
TEST_F(Driven, StandsWhenTheStreamStops) {
  session().drive({200, Motion::kStraight});
  session().allow_motion(true);
  rig.run(100);
  EXPECT_EQ(speeds().left, 200);
  (void)rig.device.feed(test::hex_text("96 00"));
  int slowest = 200;
  for (int ms = 0; ms < 600; ++ms) {
    rig.run(1);
    slowest = std::min(slowest, speeds().left);
  }
  EXPECT_EQ(slowest, 0);
  EXPECT_EQ(speeds().left, 200) << "it was asked for again, and came";
}

TEST_F(Driven, PickedUpItStandsAndStaysSo) {
  session().drive({200, Motion::kStraight});
  session().allow_motion(true);
  rig.run(100);
  rig.device.lift();
  EXPECT_EQ(speeds().left, 0);
  rig.run(2'000);
  EXPECT_EQ(speeds().left, 0) << "commands are nothing to a robot in passive";
  EXPECT_EQ(rig.device.mode(), 1);
}

TEST_F(Driven, AtTheEndItStandsInPassive) {
  session().drive({200, Motion::kStraight});
  session().allow_motion(true);
  rig.run(100);
  session().stand();
  rig.driver.push(rig.clock.now());
  rig.run(2);
  EXPECT_EQ(speeds().left, 0);
  EXPECT_EQ(rig.device.mode(), 1);
  rig.run(500);
  EXPECT_EQ(speeds().left, 0) << "and gets no command to go on";
}

// A damaged frame costs nothing but itself: the pose at the end is that of the counts.
TEST(HostileCreate, DamageCostsNoMotion) {
  Rig rig(config_of(Model::kCreate2), CreateModel::kTwo, true);
  rig.run(90);
  rig.link.corruptor().set(0.01);
  rig.left_a_frame = 3;
  rig.right_a_frame = 3;
  const std::size_t before = rig.frames.size();
  rig.run(3'600'000);
  EXPECT_GT(rig.link.corrupted(), 15'000U);
  EXPECT_GE(rig.frames.size() - before + rig.link.corrupted() + 40, 240'000U) << "one frame a damaged byte";
  rig.link.corruptor().set(0);
  rig.stand();
  rig.run(1'000);
  RecordProperty("frames", static_cast<int>(rig.frames.size()));
  RecordProperty("implausible", static_cast<int>(rig.driver.session().counts().impossible));
  // 720000 counts of 0.444565 mm. Two errors in a frame may cancel out in its sum. If the counts are then beyond what
  // the wheels can do, the motion of two frames is lost, 2.7 mm.
  EXPECT_NEAR(rig.last.x.to_double(), 320.0868, 0.05);
  EXPECT_LT(rig.driver.session().counts().impossible, 10U);
}

}  // namespace
}  // namespace fencepost::create
