// The motors' pins, traced: they drive after `go` alone, and whatever speaks against it ends that.
#include <array>
#include <string>

#include "tests/boards/pico/driven_pico.hpp"

namespace fencepost::test {
namespace {

struct Pins {
  std::string image;
  std::array<std::string, 2> power;
  std::string at_high;  ///< a direction that is high while the robot goes ahead; none: the wiring says it
};
const Pins kPico = {"fencepost", {"pin 16", "pin 17"}, ""};
const Pins kXrp = {"fencepost-xrp", {"pin 7", "pin 15"}, "pin 6"};

class Motors : public DrivenPico {
 protected:
  explicit Motors(Pins pins = kPico) : DrivenPico(pins.image), pins_(std::move(pins)) {}

  void ready() {
    ASSERT_TRUE(bench.obey("set bumper 40", "bumper = 40 %; a new run")) << bench.said();
    set_off();
    bench.clear();
  }
  void go() {
    ready();
    bench.console().send("go\r");
    drive(0.5);
    ASSERT_NE(bench.said().find("ahead, at 40 %"), std::string::npos) << bench.said();
    ASSERT_TRUE(run_in_the_last(0.1));
  }
  /// Both have pulses then.
  bool run_in_the_last(double seconds) {
    const double since = bench.seconds() - seconds;
    for (const std::string& pin : pins_.power) {
      const auto all = changes(pin);
      if (all.empty() || (all.back().t < since)) return false;
    }
    return true;
  }
  /// The share of that time in which the pin was high, over whole periods; 0 without any.
  double duty_in_the_last(double seconds, const std::string& pin) {
    const double since = bench.seconds() - seconds;
    double began = 0;
    double rose = 0;
    double on = 0;
    double on_before = 0;
    for (const Change& change : changes(pin)) {
      if (change.t < since || (!change.high && rose == 0)) continue;
      if (!change.high) {
        on += change.t - rose;
        continue;
      }
      if (began == 0) began = change.t;
      rose = change.t;
      on_before = on;
    }
    return rose > began ? on_before / (rose - began) : 0;
  }
  /// The later of both; they are low.
  double stood() { return std::max(fallen(pins_.power[0]), fallen(pins_.power[1])); }
  bool never_ran() { return changes(pins_.power[0]).empty() && changes(pins_.power[1]).empty(); }

  Pins pins_;
};
struct XrpMotors : Motors {
  XrpMotors() : Motors(kXrp) {}
};

TEST_F(Motors, StandUntilSomebodyTypesGo) {
  ASSERT_TRUE(bench.obey("go", "it may move while no alert forbids it; no motor is driven")) << bench.said();
  ready();
  drive(1.0);
  EXPECT_TRUE(high()) << "it may move";
  EXPECT_TRUE(never_ran());
  machine->command("run-pin");
  ASSERT_TRUE(bench.await("READY\r\n"));
  EXPECT_TRUE(bench.obey("get bumper", "bumper = 40 %")) << "kept";
  bench.console().send("go\r");
  drive(0.1);
  EXPECT_NE(bench.said().find("error: it may not move now"), std::string::npos) << bench.said();
  drive(1.5);
  EXPECT_TRUE(high());
  EXPECT_TRUE(never_ran()) << "what was refused does not come later";
}

TEST_F(Motors, HaveThePowerThatTheyWereGiven) {
  go();
  for (const std::string& pin : pins_.power) EXPECT_NEAR(duty_in_the_last(0.3, pin), 0.40, 0.01);
}

TEST_F(Motors, HaveLessWhereTheRobotIsTooFastAndThenNone) {
  bench.console().send(line_of(level_pixy2()));  // without the lens height the speed limit is not known
  speed_ = 0.02;
  go();
  speed_ = 0.3;  // it stays: these wheels do not obey
  std::vector<double> power;
  for (int i = 0; i < 50 && bench.said().find(",stop,") == std::string::npos; ++i) {
    drive(0.1);
    power.push_back(duty_in_the_last(0.08, pins_.power[0]));
  }
  ASSERT_GT(power.size(), 5U) << bench.said().substr(0, 2'000);
  EXPECT_NEAR(power.front(), 0.40, 0.02) << "nothing is near yet";
  const double last = power[power.size() - 2];
  EXPECT_LT(last, 0.35) << "before STOP";
  EXPECT_GT(last, 0.1) << "it goes on, more slowly";
  drive(0.1);
  EXPECT_LT(stood(), bench.seconds());
}

TEST_F(Motors, FallWithTheRecordThatSaysStopAndStayThere) {
  go();
  double said = 0;
  for (int i = 0; i < 300 && said == 0; ++i) {
    drive(0.02);
    if (bench.said().find(",stop,") != std::string::npos) said = bench.seconds();
  }
  ASSERT_GT(said, 0) << bench.said().substr(0, 2'000);
  bench.run(0.03);
  EXPECT_LE(stood(), said + 0.02);
  EXPECT_NE(bench.said().find("the motors stand: STOP"), std::string::npos) << bench.said();
  const double then = stood();
  speed_ = -0.16;  // carried back: it may move, but does not
  drive(4.0);
  EXPECT_TRUE(high());
  EXPECT_EQ(stood(), then);
}

struct MotorsAndALine : Motors, ::testing::WithParamInterface<const char*> {};
TEST_P(MotorsAndALine, Fall) {
  go();
  const double typed = bench.seconds();
  bench.console().send(GetParam());
  drive(0.1);
  EXPECT_LE(stood() - typed, 0.03);
}
INSTANTIATE_TEST_SUITE_P(OfAnyKind, MotorsAndALine, ::testing::Values("\r", "stop\r", "status\r", "?!\r"));

TEST_F(Motors, AreHeldByStopWhichReleasesNothing) {
  go();
  bench.console().send("stop\r");
  drive(0.1);
  EXPECT_FALSE(high()) << "the pin, too";
  drive(2.0);
  EXPECT_FALSE(high());
  EXPECT_FALSE(run_in_the_last(1.9));
}

TEST_F(Motors, FallWhenTheCameraIsGone) {
  go();
  const double gone = bench.seconds();
  bench.unplug_camera(true);
  drive(0.6, false);
  EXPECT_LE(stood() - gone, 0.4);
}

TEST_F(Motors, FallWhenOdometryContradicts) {
  go();
  speed_ = 0;
  drive(1.3);
  EXPECT_NE(bench.said().find("the motors stand: by odometry they have not moved it"), std::string::npos)
      << bench.said();
  EXPECT_FALSE(run_in_the_last(0.2));
}

TEST_F(Motors, FallWhenItGoesBackwards) {
  go();
  speed_ = -0.16;
  drive(1.0);
  EXPECT_NE(bench.said().find("the motors stand: by odometry it goes backwards"), std::string::npos) << bench.said();
  EXPECT_FALSE(run_in_the_last(0.2));
}

TEST_F(Motors, FallWhenTheLoopHangs) {
  go();
  const double begun = bench.seconds();
  machine->command("hang");
  bench.run(0.6);
  EXPECT_LE(stood() - begun, 0.5);
  EXPECT_GE(stood() - begun, 0.3) << "it was the watchdog";
  ASSERT_TRUE(bench.await("reset: watchdog", 2)) << bench.said();
  const double then = stood();
  drive(2.0);
  EXPECT_EQ(stood(), then) << "and they stay there in the next run";
}

TEST_F(Motors, FallAtOnceInAPanicAndInAReset) {
  go();
  double begun = bench.seconds();
  machine->command("fault");
  bench.run(0.1);
  EXPECT_LE(stood() - begun, 0.001);
  ASSERT_TRUE(bench.await("READY\r\n"));
  go();
  begun = bench.seconds();
  machine->command("run-pin");
  bench.run(0.1);
  EXPECT_LE(stood() - begun, 0.001);
}

// The probe resets the core alone: the modulator would go on.
TEST_F(Motors, FallWhenADebuggerResetsTheCore) {
  go();
  const double begun = bench.seconds();
  machine->command("probe");
  bench.run(0.1);
  EXPECT_LE(stood() - begun, 0.02);
}

TEST_F(Motors, FallWhenADebuggerHaltsTheCore) {
  go();
  const double begun = bench.seconds();
  machine->command("halt");
  bench.run(0.6);
  EXPECT_LE(stood() - begun, 0.5);
  EXPECT_GE(stood() - begun, 0.3) << "it was the watchdog";
  EXPECT_TRUE(bench.await("reset: watchdog", 2)) << bench.said();
}

// Its cable is out, its program has closed it: nobody there can stop them any more.
struct MotorsAndAPort : Motors, ::testing::WithParamInterface<const char*> {
  void type(const std::string& line) {
    machine->line(EmulatedPico::kUsb).send(line);
    drive(0.5);
  }
};
TEST_P(MotorsAndAPort, FallWhenItIsGone) {
  ready();
  machine->command("usb plug");
  drive(0.1);
  type("go\r");
  ASSERT_TRUE(run_in_the_last(0.1)) << bench.said();
  const double gone = bench.seconds();
  machine->command(GetParam());
  drive(0.3);
  EXPECT_LE(stood() - gone, 0.03);
  EXPECT_NE(bench.said().find("the motors stand: the port was closed"), std::string::npos) << bench.said();
}
INSTANTIATE_TEST_SUITE_P(InAnyWay, MotorsAndAPort, ::testing::Values("usb close", "usb unplug", "usb plug"));

struct MotorsAndAButton : Motors {
  void press() {
    machine->command("button down");
    drive(0.1);
    machine->command("button up");
    drive(0.4);
  }
};
TEST_F(MotorsAndAButton, GoAndStandByIt) {
  ready();
  press();
  ASSERT_TRUE(run_in_the_last(0.1)) << bench.said();
  const double pressed = bench.seconds();
  press();
  EXPECT_LE(stood() - pressed, 0.05);
  EXPECT_FALSE(high()) << "held, as by `stop`";
  press();
  EXPECT_TRUE(run_in_the_last(0.1)) << "and released by the next one";
}
TEST_F(MotorsAndAButton, NeedNoPort) {
  ready();
  machine->command("usb plug");
  drive(0.1);
  press();
  machine->command("usb unplug");
  drive(0.3);
  EXPECT_TRUE(run_in_the_last(0.1)) << bench.said();
}
TEST_F(MotorsAndAButton, WaitUntilItIsLetGo) {
  bench.clear();
  machine->command("power");
  machine->command("button down");
  ASSERT_TRUE(bench.await("READY\r\n"));
  ready();
  drive(1.0);
  EXPECT_TRUE(never_ran()) << "it is stuck, or something hangs at its pin";
}

TEST_F(XrpMotors, GoAhead) {
  EXPECT_TRUE(never_ran());
  go();
  EXPECT_TRUE(high("pin 6")) << "left";
  EXPECT_TRUE(changes("pin 14").empty()) << "right, mounted the other way round";
  const double typed = bench.seconds();
  bench.console().send("\r");
  drive(0.1);
  EXPECT_LE(stood() - typed, 0.03);
}

}  // namespace
}  // namespace fencepost::test
