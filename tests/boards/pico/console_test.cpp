// The Pico's console is on USB and on a serial line at the same time.
#include <gtest/gtest.h>

#include "host/replay/replay.hpp"
#include "host/result/lookup.hpp"
#include "tests/boards/bench.hpp"
#include "tests/boards/pico/pico.hpp"

namespace fencepost::test {
namespace {

struct PicoConsole : ::testing::Test {
  EmulatedPico* machine = nullptr;
  Bench bench{pico(&machine)};
  Line& usb = machine->line(EmulatedPico::kUsb);

  void SetUp() override { ASSERT_TRUE(bench.await("READY\r\n")) << bench.said(); }
  void computer(const std::string& does) {
    machine->command("usb " + does);
    bench.run(0.1);
  }
  std::string usb_says(const std::string& typed) {
    static_cast<void>(usb.take());
    usb.send(typed + "\r");
    bench.run(0.2);
    return usb.take();
  }
};

TEST_F(PicoConsole, AnswersOnBothWhateverWasTypedWhere) {
  computer("plug");
  bench.clear();
  const std::string answer = usb_says("version");
  EXPECT_NE(answer.find("fencepost 0.1.0 for pico"), std::string::npos) << answer;
  EXPECT_EQ(bench.said(), answer);
  EXPECT_TRUE(bench.obey("version", "fencepost 0.1.0 for pico"));
  bench.run(0.1);
  EXPECT_EQ(usb.take(), bench.said());
}

TEST_F(PicoConsole, WorksWithoutUsbAndAfterItIsGone) {
  EXPECT_TRUE(bench.obey("version", "for pico")) << "nobody has plugged it in yet";
  computer("plug");
  EXPECT_NE(usb_says("version"), "");
  computer("unplug");
  EXPECT_TRUE(bench.obey("version", "for pico"));
  bench.run(0.1);
  EXPECT_EQ(usb.take(), "");
  computer("plug");
  EXPECT_NE(usb_says("version").find("for pico"), std::string::npos);
}

TEST_F(PicoConsole, IsNotHeldUpByAPortThatIsClosedOrNeverRead) {
  computer("plug");
  EXPECT_NE(usb_says("version"), "") << "it leads now";
  computer("block");
  for (int i = 0; i < 20; ++i) {
    EXPECT_TRUE(bench.obey("help", "selftest") && bench.obey("version", "for pico")) << i;
  }
  computer("unblock");
  static_cast<void>(usb.take());
  EXPECT_NE(usb_says("version").find("for pico"), std::string::npos);
  computer("close");
  EXPECT_TRUE(bench.obey("version", "for pico"));
  bench.run(0.1);
  EXPECT_EQ(usb.take(), "") << "nobody listens: nothing is kept for later";
  computer("open");
  EXPECT_NE(usb_says("version").find("for pico"), std::string::npos);
}

// It has closed the port while a packet waited, which goes back: the next one has its number in the sequence.
TEST_F(PicoConsole, LosesNothingAfterAPortWasClosedUnread) {
  const std::string facts = "fencepost 0.1.0 for pico, profile small\r\nreset: power on\r\npanic: none\r\n";
  computer("plug");
  for (int i = 0; i < 4; ++i) {
    EXPECT_NE(usb_says("version"), "");
    computer("block");
    EXPECT_TRUE(bench.obey("version", "for pico"));
    computer("close");
    computer("open");
    static_cast<void>(usb.take());
    computer("unblock");
    EXPECT_EQ(usb.take(), facts) << i;
  }
}

TEST_F(PicoConsole, GoesOnAfterAHaltWasCleared) {
  computer("plug");
  for (int i = 0; i < 4; ++i) {
    EXPECT_NE(usb_says("version").find("fencepost 0.1.0 for pico"), std::string::npos) << i;
    computer("clear-in");
    computer("clear-out");
  }
  EXPECT_NE(usb_says("version").find("fencepost 0.1.0 for pico"), std::string::npos);
  computer("block");
  EXPECT_TRUE(bench.obey("version", "for pico"));
  computer("clear-in");
  static_cast<void>(usb.take());
  computer("unblock");
  EXPECT_TRUE(usb.take().starts_with("fencepost 0.1.0 for pico")) << "the packet that waited begins the sequence";
}

// A buffer's end and the next request at the same time: the descriptors are still whole.
TEST_F(PicoConsole, IsFoundWhenItsInterruptComesLate) {
  computer("late");
  computer("plug");
  EXPECT_NE(usb_says("version").find("fencepost 0.1.0 for pico"), std::string::npos);
}

TEST_F(PicoConsole, AnswersARequestAfterOneThatWasGivenUp) {
  computer("plug");
  for (int i = 0; i < 3; ++i) {
    computer("give-up");
    EXPECT_NE(usb_says("version").find("fencepost 0.1.0 for pico"), std::string::npos) << i;
  }
}

// Revisions before B2 have no abort of a buffer (tests/boards/pico/usb_wire.mjs says where one is tried).
TEST_F(PicoConsole, WorksOnAnOldPart) {
  bench.clear();
  machine->command("revision 1");
  machine->command("power");
  ASSERT_TRUE(bench.await("READY\r\n"));
  computer("plug");
  computer("give-up");
  EXPECT_NE(usb_says("version").find("fencepost 0.1.0 for pico"), std::string::npos);
  computer("close");
  computer("open");
  EXPECT_NE(usb_says("version").find("fencepost 0.1.0 for pico"), std::string::npos);
}

// Nobody could have heard it when it was said.
TEST_F(PicoConsole, TellsOfTheLastRunWhenItsPortIsOpened) {
  bench.clear();
  machine->command("fault");
  ASSERT_TRUE(bench.await("READY\r\n")) << bench.said();
  computer("plug");
  const std::string said = usb.take();
  EXPECT_NE(said.find("reset: panic\r\npanic: exception 3 at 200"), std::string::npos) << said;
  EXPECT_EQ(said.find("READY"), std::string::npos) << said;
}

// A thousand records at once are more than its queues hold: USB waits for the program, nothing is lost.
TEST_F(PicoConsole, TakesAsMuchAtOnceAsAComputerSends) {
  computer("plug");
  usb_says("mode log");
  usb_says("reset");
  usb.set_pace(1e6);
  std::string lines;
  for (int i = 0; i < 1000; ++i) {
    sensor::OdometrySample sample;
    sample.x = base::Metres::nearest(0.001 * i);
    lines += unstamped(sample);
  }
  usb.send(lines);
  bench.run(4);
  bench.clear();
  const std::string status = usb_says("status");
  // Those that come in one turn of the loop have one time, and only the first of a time counts.
  const auto number = [&status](std::string_view name) {
    return std::stoi(status.substr(status.rfind(name) + name.size()));
  };
  EXPECT_EQ(number("; odometry ") + number("; rejected "), 1000) << status;
}

TEST_F(PicoConsole, ReplaysALogFromUsb) {
  const SceneStream stream = stream_of(recorded_scene("approach_stop"));
  ASSERT_TRUE(bench.await_camera());
  computer("plug");
  usb_says("mode log");
  std::string log = usb_says("reset");
  bench.play(stream, [&](double) { log += usb.take(); });
  bench.run(0.2);
  const std::string digest = bench.digest();
  bench.run(0.2);
  log += usb.take();
  const host::ReplayOutcome replayed = host::replay(log, "usb", {});
  ASSERT_FALSE(replayed.unreadable) << log.substr(0, 500);
  EXPECT_EQ(host::digest_text(replayed.result.digest), digest);
  EXPECT_GT(replayed.result.log.frames, 20U);
}

}  // namespace
}  // namespace fencepost::test
