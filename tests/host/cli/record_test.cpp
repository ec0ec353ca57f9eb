// `fencepost record` as a process, on a pseudo-terminal whose other end the test holds.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <random>

#include "hal/base/crc16.hpp"
#include "tests/hal/linux/pty.hpp"
#include "tests/host/cli/process.hpp"

namespace fencepost::host {
namespace {

using linux::FarEnd;
using namespace testing;

const std::string kOdometry = "$FPODO,7.6200,1.3820,-0.0145,0.0666*DAD3\r\n";  // from approach_stop.log
const std::string kNext = "$FPODO,7.6400,1.3860,-0.0143,0.0666*9409\r\n";      // likewise

class Record : public ::testing::Test {
 protected:
  [[nodiscard]] std::string log() const { return slurp(folder.path() / "run.log"); }
  /// The bytes that the robot hears, until there are `size` of them.
  std::string heard(std::size_t size) {
    std::string text;
    eventually([&] { return (text += far.heard()).size() >= size; });
    return text;
  }
  /// Without those that have the program's own words.
  std::vector<std::string> files() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
      const std::string name = entry.path().filename().string();
      if (entry.is_regular_file() && name != "out" && name != "err") names.push_back(name);
    }
    std::sort(names.begin(), names.end());
    return names;
  }

  Folder folder;
  std::string port = (folder.path() / "tty").string();
  FarEnd far{port};
};

TEST_F(Record, KeepsEveryByteAndShowsWholeLines) {
  Process run(folder, {"record", port, "-o", "run.log"});
  EXPECT_EQ(heard(10), "\rmode log\r");
  const std::string bytes =
      kOdometry + "mode is log\r\n" + std::string("\0\x1b[2J\xff\xfe\n", 8) + "\n$FPODO,broken*0000\n";
  far.say(bytes + "no end");
  ASSERT_TRUE(run.shows("broken*0000\n"));
  EXPECT_EQ(run.out(), bytes);
  EXPECT_EQ(log(), bytes + "no end");
  EXPECT_EQ(run.end(SIGINT), 130);
  EXPECT_EQ(run.out(), bytes + "no end");
  EXPECT_EQ(log(), bytes + "no end");
  EXPECT_TRUE(holds(run.err(), "6 lines, "));
  EXPECT_TRUE(holds(run.err(), "1 record: 0 frames, 1 of odometry; 4 foreign lines\nrejected lines: crc 1\n"));
  EXPECT_TRUE(run.err().ends_with("saved in run.log\n")) << run.err();
}

TEST_F(Record, SigtermAndSighupEndItInOrder) {
  for (const int signal : {SIGTERM, SIGHUP}) {
    Process run(folder, {"record", port, "-o", "run.log"});
    ASSERT_EQ(heard(10), "\rmode log\r");
    far.say("before the end");
    ASSERT_TRUE(eventually([this] { return !log().empty(); }));
    EXPECT_EQ(run.end(signal), signal == SIGTERM ? 0 : 130);
    EXPECT_EQ(log(), "before the end");
    EXPECT_TRUE(run.err().ends_with("saved in run.log\n")) << run.err();
    std::filesystem::remove(folder.path() / "run.log");
  }
}

TEST_F(Record, WhatIsTypedGoesToTheRobot) {
  Process run(folder, {"record", port, "-o", "run.log", "--no-command"});
  ASSERT_TRUE(run.says("Ctrl-C ends it"));
  run.type("status\n$FPODO,1.0000,0.0000,0.0000,0.0000*1234\n");
  EXPECT_EQ(heard(47), "status\n$FPODO,1.0000,0.0000,0.0000,0.0000*1234\n");
  run.hang_up();
  far.say("still there\n");
  EXPECT_TRUE(run.shows("still there\n"));
}

TEST_F(Record, AsksForTheModeAndANewRun) {
  const Process run(folder, {"record", port, "-o", "run.log", "--mode", "plot", "--reset"});
  EXPECT_EQ(heard(17), "\rmode plot\rreset\r");
}

// A board that boots when its port is opened misses the first one.
TEST_F(Record, AsksAgainUntilARecordComes) {
  Process run(folder, {"record", port, "-o", "run.log"});
  EXPECT_EQ(heard(20), "\rmode log\r\rmode log\r");
  far.say(kOdometry);
  ASSERT_TRUE(run.shows(kOdometry));
}

TEST_F(Record, GoesOnAfterAReplug) {
  Process run(folder, {"record", port, "-o", "run.log"});
  ASSERT_EQ(heard(10), "\rmode log\r");
  far.say(kOdometry + "$FPODO,cut");
  ASSERT_TRUE(eventually([this] { return log().ends_with("cut"); }));
  far.unplug();
  ASSERT_TRUE(run.says(port + " has gone; the recording goes on when it is back\n"));
  run.type("lost\n");
  ASSERT_TRUE(run.says("not sent: " + port + " is not there\n"));
  far.plug();
  ASSERT_TRUE(run.says(port + " is back\n"));
  EXPECT_EQ(heard(10), "\rmode log\r");
  far.say(kNext);
  ASSERT_TRUE(run.shows("cut\n" + kNext));
  EXPECT_EQ(run.end(SIGINT), 130);
  EXPECT_EQ(log(), kOdometry + "$FPODO,cut\n" + kNext);
  EXPECT_TRUE(holds(run.err(), "2 records"));
  EXPECT_EQ(files(), std::vector<std::string>{"run.log"});
}

TEST_F(Record, WaitsForAPortWhenTold) {
  far.unplug();
  Process run(folder, {"record", port, "-o", "run.log", "--wait"});
  ASSERT_TRUE(run.says("waiting for it: cannot open the serial port " + port));
  far.plug();
  EXPECT_EQ(heard(10), "\rmode log\r");
  far.say(kOdometry);
  EXPECT_TRUE(run.shows(kOdometry));
}

TEST_F(Record, APortThatIsNotThereIsSaidAndLeavesNoFile) {
  far.unplug();
  EXPECT_TRUE(ends(shell(folder, "fencepost record " + port), 4,
                   "cannot open the serial port " + port + ": No such file or directory; plug it in"));
  EXPECT_TRUE(files().empty());
}

TEST_F(Record, NeverOverwrites) {
  spill(folder.path() / "run.log", "old");
  EXPECT_TRUE(ends(shell(folder, "fencepost record " + port + " -o run.log"), 4,
                   "cannot create the log run.log: File exists; choose another name"));
  EXPECT_EQ(log(), "old");
}

TEST_F(Record, NamesTheFileByTheTime) {
  Process run(folder, {"record", port, "--no-command", "--seconds", "0.1"});
  EXPECT_EQ(run.wait(), 0) << run.err();
  ASSERT_EQ(files().size(), 1U);
  std::string name = files().front();
  for (char& c : name) c = c >= '0' && c <= '9' ? 'd' : c;
  EXPECT_EQ(name, "fencepost-dddddddd-dddddd.log");
}

// The order: a line that could not be kept is not shown.
TEST_F(Record, AFullDiskEndsItAndNothingIsShownThatIsNotKept) {
  Process run(folder, {"record", port, "-o", "/dev/full"});
  ASSERT_EQ(heard(10), "\rmode log\r");
  far.say(kOdometry);
  EXPECT_EQ(run.wait(), 4);
  EXPECT_EQ(run.out(), "");
  EXPECT_TRUE(holds(run.err(), "cannot write the log /dev/full: No space left on device; free some space"));
}

TEST_F(Record, GoesOnInNewFilesThatAreOneRecording) {
  Process run(folder, {"record", port, "-o", "run.log", "--no-command", "--log-size", "4K"});
  ASSERT_TRUE(run.says("Ctrl-C ends it"));
  std::string all;
  for (int i = 0; i < 3; ++i) {
    const std::string lines(3'000, static_cast<char>('a' + i));
    far.say(lines + "\n");
    all += lines + "\n";
    ASSERT_TRUE(eventually([&] { return run.out().size() == all.size(); }));
  }
  EXPECT_EQ(run.end(SIGINT), 130);
  EXPECT_EQ(files(), (std::vector<std::string>{"run-0002.log", "run.log"}));
  EXPECT_EQ(log().size(), 6'002U) << "a part ends with a line";
  EXPECT_EQ(log() + slurp(folder.path() / "run-0002.log"), all);
  EXPECT_TRUE(holds(run.err(), "saved in run.log to run-0002.log\n"));
}

TEST_F(Record, AReaderThatStopsReadingIsNoError) {
  const Outcome run = shell(folder, "{ seq 100000 | fencepost record - -o run.log; echo $? >code; } | head -1");
  EXPECT_EQ(run.out, "1\n");
  EXPECT_EQ(slurp(folder.path() / "code"), "0\n") << run.err;
  EXPECT_EQ(slurp(folder.path() / "run.log").size(), 588'895U);  // 9*2 + 90*3 + ... + 90000*6 + 7
}

TEST_F(Record, StandardInputEndsIt) {
  const Outcome run = shell(folder, "printf 'one\\ntwo' | fencepost record - -o run.log");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.out, "one\ntwo");
  EXPECT_EQ(log(), "one\ntwo");
}

TEST_F(Record, WhatWasRecordedCanBeReplayed) {
  const Outcome run = shell(folder, "fencepost record - -q -o run.log <" + testing::recording("approach_stop.log") +
                                        " && fencepost replay run.log");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(log(), slurp(FENCEPOST_SOURCE_DIR "/host/share/recordings/approach_stop.log"));
}

TEST_F(Record, ATcpPortIsAPort) {
  linux::Descriptor listener(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  auto* any = static_cast<sockaddr*>(static_cast<void*>(&address));
  ASSERT_EQ(::bind(listener.get(), any, size), 0);
  ASSERT_EQ(::listen(listener.get(), 1), 0);
  ASSERT_EQ(::getsockname(listener.get(), any, &size), 0);
  Process run(folder, {"record", "tcp:127.0.0.1:" + std::to_string(ntohs(address.sin_port)), "-o", "run.log"});
  const linux::Descriptor peer(::accept(listener.get(), nullptr, nullptr));
  ASSERT_EQ(::write(peer.get(), kOdometry.data(), kOdometry.size()), static_cast<ssize_t>(kOdometry.size()));
  EXPECT_TRUE(run.shows(kOdometry));
  std::array<char, 10> heard{};
  EXPECT_EQ(::recv(peer.get(), heard.data(), heard.size(), MSG_WAITALL), 10);
  EXPECT_EQ(std::string(heard.data(), heard.size()), "\rmode log\r");
}

// The devices are missing: the log has the start of a run, and their links.
TEST_F(Record, DevicesOfThisMachineAreRecordedWithoutAConsole) {
  const std::string line = "fencepost record --camera pixy2:./no --odometry create2:./nor --wait --seconds 0.2 -o ";
  const Outcome run = shell(folder, line + "run.log");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_TRUE(log().starts_with("$FPHDR,1,fencepost,")) << log();
  EXPECT_NE(log().find(",pixy2,absent,./no*"), std::string::npos) << log();
  EXPECT_NE(log().find(",create2,absent,./nor*"), std::string::npos) << log();
  const Outcome full = shell(folder, line + "/dev/full");
  EXPECT_EQ(full.exit_code, 4);
  EXPECT_TRUE(holds(full.err, "/dev/full: No space left on device"));
  EXPECT_FALSE(holds(full.err, "goes on without a log"));
}

TEST_F(Record, UsageErrorsAreSaid) {
  for (const std::string& line : std::vector<std::string>{
           "fencepost record", "fencepost record " + port + " -o -", "fencepost record tcp:nowhere",
           "fencepost record " + port + " --mode nonsense", "fencepost record " + port + " --baud 0",
           "fencepost record " + port + " --no-command --reset", "fencepost record --camera pixy2:/dev/null",
           "fencepost record --camera pixy2:/no --odometry create2:/no " + port,
           "fencepost record --camera console --odometry console",
           "fencepost record " + port + " --robot robot.json"}) {
    const Outcome run = shell(folder, line);
    EXPECT_EQ(run.exit_code, 2) << line;
    EXPECT_EQ(run.out, "") << line;
    EXPECT_FALSE(run.err.empty()) << line;
  }
  EXPECT_TRUE(files().empty());
}

/// Numbered lines, as fast as the pty takes them.
class Feeder {
 public:
  explicit Feeder(int fd) : fd_(fd) {}
  void feed() {
    for (int i = 0; i < 50; ++i) {
      if (rest_.empty()) rest_ = "line " + std::to_string(++number_) + "\r\n";
      const ssize_t count = ::write(fd_, rest_.data(), rest_.size());
      if (count <= 0) return;
      rest_.erase(0, static_cast<std::size_t>(count));
    }
  }

 private:
  int fd_;
  int number_ = 0;
  std::string rest_;
};

TEST_F(Record, AKillLosesNothingThatWasShown) {
  constexpr int kKills = 100;
  constexpr std::size_t kMaxMore = 50;  // portions of lines before a kill
  std::mt19937 random(20'240'607);
  std::size_t lines = 0;
  for (int round = 0; round < kKills; ++round) {
    far.plug();
    Feeder feeder(far.descriptor());
    Process run(folder, {"record", port, "-o", "run.log"});
    ASSERT_EQ(heard(10), "\rmode log\r") << run.err();
    ASSERT_TRUE(eventually([&] {
      feeder.feed();
      return !run.out().empty();
    })) << run.err();
    for (std::size_t more = random() % kMaxMore; more > 0; --more) {
      feeder.feed();
      static_cast<void>(run.out());
    }
    ASSERT_EQ(run.end(SIGKILL), 1000 + SIGKILL);
    const std::string shown = run.out().substr(0, run.out().rfind('\n') + 1);
    ASSERT_TRUE(log().starts_with(shown))
        << "round " << round << ": " << shown.size() << " bytes were shown, " << log().size() << " kept";
    ASSERT_TRUE(shown.starts_with("line 1\r\n"));
    lines += static_cast<std::size_t>(std::count(shown.begin(), shown.end(), '\n'));
    std::filesystem::remove(folder.path() / "run.log");
  }
  EXPECT_GE(lines, std::size_t{kKills});
}

// The robot's name for its camera is shown to people, at the end and twice a second.
TEST_F(Record, ARobotsWordsDoNotReachTheTerminalAsControlSequences) {
  const std::string body = "FPLNK,1.0000,%1B]0;mine%07%0Aforged,silent,%C2%9B2J";
  const std::string line = fmt::format("${}*{:04X}\r\n", body, base::crc16(body));
  Process run(folder, {"record", port, "-o", "run.log"});
  EXPECT_EQ(heard(10), "\rmode log\r");
  far.say(line);
  ASSERT_TRUE(run.shows("2J*"));
  EXPECT_EQ(run.end(SIGINT), 130);
  EXPECT_EQ(log(), line) << "the file has what came";
  EXPECT_TRUE(holds(run.err(), "links at the end: ?]0;mine??forged silent (??2J)\n"));
  EXPECT_EQ(run.err().find_first_of("\x1b\x07\x9b"), std::string::npos) << run.err();
}

}  // namespace
}  // namespace fencepost::host
