// The conversation with emulated Creates, and an hour of it on a bad line.
#include "drivers/create/session.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "drivers/create/create.hpp"
#include "hal/fake/scripted_link.hpp"
#include "hal/fake/stepped_clock.hpp"
#include "host/emulate/create.hpp"
#include "tests/drivers/bytes.hpp"
#include "tests/drivers/wire.hpp"

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

/// Steps of 5 ms; a stream frame each 15 ms.
struct Rig {
  Rig(const Config& config, CreateModel model, bool header_in_checksum = false)
      : device(model, header_in_checksum), driver(wire, config) {
    (void)device.power_up();
  }

  std::optional<sensor::OdometrySample> step() {
    clock.advance(base::milliseconds(5));
    const std::string asked = wire.to_device();
    if (powered) wire.from_device(device.feed(asked));
    if (powered && ++steps % 3 == 0) {
      device.roll(left_a_frame, right_a_frame);
      device.move(mm_a_frame, degrees_a_frame);
      wire.from_device(device.frame());
    }
    const auto sample = driver.poll(clock.now());
    if (!sample) return std::nullopt;
    EXPECT_LT(last.t, sample->t);
    last = *sample;
    ++samples;
    return last;
  }
  void run(std::int64_t ms) {
    for (std::int64_t i = 0; i < ms / 5; ++i) (void)step();
  }
  void stand() {
    left_a_frame = right_a_frame = 0;
    mm_a_frame = degrees_a_frame = 0;
  }

  fake::SteppedClock clock;
  serial::Wire wire{21};
  CreateDevice device;
  Create<serial::Wire> driver;
  bool powered = true;
  int left_a_frame = 0;
  int right_a_frame = 0;
  double mm_a_frame = 0;
  double degrees_a_frame = 0;
  std::int64_t steps = 0;
  std::uint32_t samples = 0;
  sensor::OdometrySample last{{-1}, {}, {}, {}};
};

std::string sent_by(const Config& config) {
  fake::ScriptedLink<64> link({});
  Create<fake::ScriptedLink<64>> driver(link, config);
  (void)driver.poll({10});
  return {link.written().begin(), link.written().end()};
}

TEST(CreateSession, StartsAsTheOpenInterfaceSays) {
  EXPECT_EQ(sent_by(config_of(Model::kCreate2)), from_hex("80 94 02 2B 2C"));
  EXPECT_EQ(sent_by(config_of(Model::kCreate1)), from_hex("80 94 02 13 14"));
  EXPECT_EQ(sent_by(config_of(Model::kCreate2, Mode::kSafe)), from_hex("80 83 94 02 2B 2C"));
  EXPECT_EQ(sent_by(config_of(Model::kCreate2, Mode::kFull)), from_hex("80 84 94 02 2B 2C"));
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

// Right wheel forward, left back, by 4 counts a frame, 208 frames: 2 * 832 * 0.444565 / 235 = 3.1479 rad, a little more
// than half a turn: -3.1353.
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

TEST(CreateSession, ACreate1TellsMillimetresAndDegrees) {
  Rig rig(config_of(Model::kCreate1), CreateModel::kOne);
  rig.device.move(500, 90);  // before anybody listened
  rig.run(90);
  EXPECT_EQ(rig.last.x.raw, 0) << "the first reading is since who knows when";
  rig.mm_a_frame = 3;
  rig.run(1'500);
  rig.mm_a_frame = 0;
  rig.degrees_a_frame = 1;
  rig.run(1'350);
  rig.degrees_a_frame = 0;
  rig.mm_a_frame = -2;
  rig.run(1'500);
  rig.stand();
  rig.run(30);
  EXPECT_EQ(rig.last.x.raw, 3'000);
  EXPECT_EQ(rig.last.y.raw, -2'000);
  EXPECT_EQ(rig.last.heading.raw, 15'708);
}

TEST(CreateSession, ARobotThatWasSwitchedOffGoesOnFromWhereItWas) {
  Rig rig(config_of(Model::kCreate2, Mode::kSafe), CreateModel::kTwo);
  rig.left_a_frame = rig.right_a_frame = 10;
  rig.run(1'500);
  rig.stand();
  rig.run(30);
  const base::Metres before = rig.last.x;
  EXPECT_GT(before.raw, 4'000);
  rig.powered = false;
  rig.run(3'000);
  EXPECT_EQ(rig.driver.link(), LinkState::kSilent);
  (void)rig.device.power_up();
  rig.powered = true;
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
  rig.wire.unplug();
  rig.run(300);
  EXPECT_EQ(rig.driver.link(), LinkState::kAbsent);
  rig.wire.replug();
  rig.run(3'000);
  rig.stand();
  rig.run(30);
  EXPECT_EQ(rig.last.x.raw, 18'672) << "4200 counts";
}

// A robot that somebody drives is not taken out of its mode by a stream that fell silent.
TEST(CreateSession, AsksForTheStreamBeforeItStartsAnew) {
  Rig rig(config_of(Model::kCreate2), CreateModel::kTwo);
  rig.run(300);
  (void)rig.device.feed(from_hex("84 96 00"));  // full mode, stream paused
  rig.run(450);
  EXPECT_EQ(rig.driver.link(), LinkState::kOk);
  rig.run(600);
  EXPECT_EQ(rig.driver.link(), LinkState::kOk);
  EXPECT_EQ(rig.device.mode(), 3);
  EXPECT_EQ(rig.driver.session().counts().starts, 2U);
}

TEST(CreateSession, CarriesCommandsOfWhoeverDrives) {
  fake::ScriptedLink<64> link({});
  Create<fake::ScriptedLink<64>> driver(link, config_of(Model::kCreate2, Mode::kFull));
  (void)driver.poll({10});
  EXPECT_TRUE(driver.session().command(octets(from_hex("91 00 64 00 64"))));
  EXPECT_FALSE(driver.session().command(std::vector<std::uint8_t>(9))) << "too long";
  (void)driver.poll({20});
  const std::string sent(link.written().begin(), link.written().end());
  EXPECT_EQ(sent, from_hex("80 84 94 02 2B 2C 91 00 64 00 64"));
}

TEST(CreateSession, BytesThatAreNoStreamAreUnready) {
  Rig rig(config_of(Model::kCreate2), CreateModel::kTwo);
  rig.powered = false;
  for (int i = 0; i < 400; ++i) {
    rig.wire.from_device("\x13\x06\x2Bxy");
    (void)rig.step();
  }
  EXPECT_EQ(rig.driver.link(), LinkState::kUnready);
  rig.run(600);
  EXPECT_EQ(rig.driver.link(), LinkState::kSilent);
  EXPECT_EQ(rig.samples, 0U);
}

TEST(CreateSession, APortThatTakesNothingDoesNotHang) {
  fake::ScriptedLink<64> link({});
  link.limit_writes(0);
  Create<fake::ScriptedLink<64>> driver(link, Config{});
  for (std::int64_t ms = 0; ms < 60'000; ms += 10) EXPECT_FALSE(driver.poll({ms * 10}).ok());
  EXPECT_EQ(driver.link(), LinkState::kSilent);
}

// A damaged frame costs nothing but itself: the pose at the end is that of the counts.
TEST(HostileCreate, DamageCostsNoMotion) {
  Rig rig(config_of(Model::kCreate2), CreateModel::kTwo, true);
  rig.run(90);
  rig.wire.damage_one_byte_in(100);
  rig.left_a_frame = 3;
  rig.right_a_frame = 3;
  const std::uint32_t before = rig.samples;
  rig.run(3'600'000);
  EXPECT_GT(rig.wire.damaged_bytes(), 15'000U);
  EXPECT_GE(rig.samples - before + rig.wire.damaged_bytes() + 40, 240'000U) << "one frame a damaged byte";
  rig.wire.damage_one_byte_in(0);
  rig.stand();
  rig.run(1'000);
  RecordProperty("frames", static_cast<int>(rig.samples));
  RecordProperty("implausible", static_cast<int>(rig.driver.session().counts().impossible));
  // 720000 counts of 0.444565 mm. Two errors in a frame may cancel out in its sum: then, if the counts are beyond what
  // the wheels can do, the motion of two frames is lost, 2.7 mm.
  EXPECT_NEAR(rig.last.x.to_double(), 320.0868, 0.05);
  EXPECT_LT(rig.driver.session().counts().impossible, 10U);
}

TEST(HostileCreate, AnHourOfEverything) {
  for (const auto& [model, kind] :
       {std::pair{Model::kCreate1, CreateModel::kOne}, {Model::kCreate2, CreateModel::kTwo}}) {
    Rig rig(config_of(model), kind);
    rig.wire.damage_one_byte_in(100);
    rig.left_a_frame = 5;
    rig.right_a_frame = 6;
    rig.mm_a_frame = 3;
    for (int minute = 0; minute < 60; ++minute) {
      switch (minute % 6) {
        case 1: rig.wire.stall(true); break;
        case 2: rig.wire.unplug(); break;
        case 3: rig.powered = false; break;
        default: break;
      }
      rig.run(300 + static_cast<std::int64_t>(rig.wire.random()() % 5'000));
      rig.wire.stall(false);
      rig.wire.replug();
      if (!rig.powered) (void)rig.device.power_up();
      rig.powered = true;
      const std::uint32_t before = rig.samples;
      rig.run(60'000);
      EXPECT_GT(rig.samples, before + 3'000) << "minute " << minute << ": did not come back";
    }
  }
}

}  // namespace
}  // namespace fencepost::create
