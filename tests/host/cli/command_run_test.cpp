// `fencepost run` on emulated devices: what it logs, says and survives.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <regex>

#include "firmware/record/encode.hpp"
#include "host/live/write_behind.hpp"
#include "tests/host/cli/fake_robot.hpp"
#include "tests/host/cli/process.hpp"
#include "tests/text.hpp"

namespace fencepost::host::testing {
namespace {

using test::count;

constexpr const char* kRobot =
    R"({"camera": {"mount": {"z": 0.12}}, "signatures": [{"id": 1, "name": "red", "rgb": "d02020"}]})";

class CommandRunAlone : public ::testing::Test {
 protected:
  CommandRunAlone() { spill(folder.path() / "robot.json", kRobot); }

  [[nodiscard]] std::vector<std::string> on_devices(std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments = {
        "run",     "--camera",  "pixy2:" + file("camera"), "--odometry", "create2:" + file("wheels"),
        "--robot", "robot.json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  [[nodiscard]] std::string file(const std::string& name) const { return (folder.path() / name).string(); }
  [[nodiscard]] std::string log(const std::string& name = "run.log") const { return slurp(folder.path() / name); }
  [[nodiscard]] bool logs(const std::string& kind, std::size_t times) const {
    return eventually([&] { return count(log(), kind) >= times; });
  }
  /// The log's replay agrees with what it holds, and has the run's digest.
  void expect_replays(const std::string& files, const std::string& digest) const {
    const Outcome replay = shell(folder, "cat " + files + " | fencepost replay --check -");
    EXPECT_EQ(replay.exit_code, 0) << replay.err;
    EXPECT_EQ(digest_in(replay.out), digest);
  }

  Folder folder;
};

/// With both devices there.
class CommandRun : public CommandRunAlone {
 protected:
  FakePixy camera{file("camera")};
  FakeCreate wheels{file("wheels")};
};

TEST_F(CommandRun, TheLogsReplayHasTheRunsDigest) {
  Process run(folder, on_devices({"--log", "run.log", "--mode", "text", "--frames", "160"}));
  EXPECT_EQ(run.wait(), 0) << run.err();
  const std::string log_text = log();
  EXPECT_EQ(count(log_text, "$FPFRM,"), 160U);
  EXPECT_GT(count(log_text, "$FPODO,"), 100U);
  EXPECT_EQ(count(log_text, "$FPHDR,1,fencepost,"), 1U);
  EXPECT_NE(log_text.find(",linux,full*"), std::string::npos);
  EXPECT_NE(log_text.find("$FPCAM,pixy2,316,208,273.66,"), std::string::npos);
  EXPECT_NE(log_text.find("$FPSIG,1,d02020,red*"), std::string::npos);
  EXPECT_NE(log_text.find("$FPDIG,"), std::string::npos);
  EXPECT_NE(log_text.find("confirmed"), std::string::npos);
  EXPECT_TRUE(holds(run.out(), "NOTICE  red  "));
  EXPECT_FALSE(holds(run.out(), "$"));
  EXPECT_TRUE(holds(run.err(), "log run.log"));
  expect_replays("run.log", digest_in(run.err()));
}

// tests/host/web/view_test.mjs looks at it in a browser, tests/host/view asks it strange things.
TEST_F(CommandRun, IsShownInBrowsersOfThisMachine) {
  Process run(folder, on_devices({"--view", "--log", "run.log", "--mode", "text", "--frames", "120"}));
  ASSERT_TRUE(run.says("the run is shown at http://127.0.0.1:")) << run.err();
  std::smatch port;
  const std::string said = run.err();
  ASSERT_TRUE(std::regex_search(said, port, std::regex("http://127.0.0.1:([0-9]+)/"))) << said;
  EXPECT_TRUE(ends(shell(folder, "fencepost run --camera console --odometry console --view " + port[1].str()), 4,
                   "127.0.0.1:" + port[1].str() + ": Address already in use"));
  EXPECT_EQ(run.wait(), 0) << run.err();
  expect_replays("run.log", digest_in(run.err()));
}

TEST_F(CommandRunAlone, ViewTakesAPortOrNone) {
  for (const char* port : {"0", "65536", "-1", "80x", "localhost"}) {
    const Outcome run = shell(folder, "fencepost run --camera console --odometry console --view=" + std::string(port));
    EXPECT_EQ(run.exit_code, 2) << port << run.err;
    EXPECT_TRUE(holds(run.err, "--view takes a port"));
  }
}

// With a log of its own, the stream would only be there twice.
TEST_F(CommandRunAlone, WithALogTheConsoleIsForPeople) {
  const std::string command = "fencepost run --camera console --odometry console < " + recording("approach_stop.log");
  EXPECT_NE(shell(folder, command).out.find("$FPODO,"), std::string::npos);
  const Outcome run = shell(folder, command + " --log run.log");
  EXPECT_TRUE(holds(run.out, "STOP  "));
  EXPECT_FALSE(holds(run.out, "$"));
}

TEST_F(CommandRun, WithoutATerminalTheConsoleIsTheLog) {
  Process run(folder, on_devices({"--frames", "60"}));
  EXPECT_EQ(run.wait(), 0) << run.err();
  EXPECT_EQ(count(run.out(), "$FPFRM,"), 60U);
  expect_replays("out", digest_in(run.err()));
}

TEST_F(CommandRun, TheConsoleObeysWhileItLogs) {
  Process run(folder, on_devices({"--log", "run.log", "--mode", "quiet"}));
  ASSERT_TRUE(logs("$FPFRM,", 60)) << run.err();
  EXPECT_TRUE(eventually([&] {
    run.type("status\n");
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    return run.out().find("camera link ok, pixy2 316x208; odometry link ok") != std::string::npos;
  })) << run.out();
  EXPECT_TRUE(holds(run.out(), "profile full, mode quiet"));
  run.type("set alert.notice 0.1\nstat\n");
  EXPECT_TRUE(run.says("alert.notice = 0.10 m")) << run.out();
  EXPECT_TRUE(run.says("error: unknown command 'stat'")) << run.out();
  EXPECT_TRUE(logs("$FPCFG,alert.notice,0.10*", 1));
  run.hang_up();  // the end of the console's input ends nothing
  const std::size_t frames = count(log(), "$FPFRM,");
  ASSERT_TRUE(logs("$FPFRM,", frames + 30));
  run.signal(SIGINT);
  EXPECT_EQ(run.wait(), 130);
  EXPECT_FALSE(holds(run.out(), "$")) << "quiet is quiet";
  expect_replays("run.log", digest_in(run.err()));
}

TEST_F(CommandRunAlone, ARunStoppedByASignalReplays) {
  const std::pair<int, int> kSignals[] = {{SIGINT, 130}, {SIGTERM, 0}, {SIGHUP, 130}};
  for (const auto& [number, code] : kSignals) {
    FakePixy camera(file("camera"));
    FakeCreate wheels(file("wheels"));
    Process run(folder, on_devices({"--log", "run.log", "--force", "--mode", "log"}));
    ASSERT_TRUE(logs("$FPFRM,", 55)) << run.err();
    run.signal(number);
    EXPECT_EQ(run.wait(), code) << "signal " << number;
    EXPECT_EQ(log().back(), '\n');
    expect_replays("run.log", digest_in(run.err()));
    expect_replays("out", digest_in(run.err()));
    std::filesystem::remove(folder.path() / "run.log");
  }
}

TEST_F(CommandRun, SurvivesACameraThatIsUnpluggedAndComesBack) {
  Process run(folder, on_devices({"--log", "run.log", "--mode", "text"}));
  ASSERT_TRUE(logs("$FPFRM,", 20)) << run.err();
  camera.device().unplug();
  ASSERT_TRUE(run.says("camera pixy2 at " + file("camera") + " is absent")) << run.err();
  const std::size_t odometry = count(log(), "$FPODO,");
  ASSERT_TRUE(logs("$FPODO,", odometry + 100)) << "it goes on with what is left";
  const std::size_t frames = count(log(), "$FPFRM,");
  camera.device().plug();
  ASSERT_TRUE(logs("$FPFRM,", frames + 60)) << run.err();
  run.signal(SIGINT);
  EXPECT_EQ(run.wait(), 130);
  EXPECT_EQ(count(run.err(), "is absent"), 1U) << run.err();
  EXPECT_GE(count(run.err(), "pixy2 at " + file("camera") + " works"), 2U) << run.err();
  EXPECT_EQ(count(log(), "pixy2,absent,"), 1U);
  EXPECT_GE(count(log(), "pixy2,ok,"), 2U);
  expect_replays("run.log", digest_in(run.err()));
}

TEST_F(CommandRun, SurvivesWheelsThatAreUnpluggedAndComeBack) {
  Process run(folder, on_devices({"--log", "run.log", "--mode", "text"}));
  ASSERT_TRUE(logs("$FPFRM,", 60)) << run.err();
  wheels.device().unplug();
  ASSERT_TRUE(run.says("odometry create2 at " + file("wheels") + " is absent")) << run.err();
  const std::size_t odometry = count(log(), "$FPODO,");
  wheels.device().plug();
  ASSERT_TRUE(logs("$FPODO,", odometry + 60)) << run.err();
  run.signal(SIGINT);
  EXPECT_EQ(run.wait(), 130);
  EXPECT_EQ(count(run.err(), "is absent"), 1U) << run.err();
  expect_replays("run.log", digest_in(run.err()));
}

TEST_F(CommandRunAlone, ADeviceThatIsNotThereIsAnErrorThatSaysWhatToDo) {
  FakeCreate wheels(file("wheels"));
  Process run(folder, on_devices());
  EXPECT_EQ(run.wait(), 4);
  EXPECT_TRUE(holds(run.err(), "pixy2: cannot open the serial port " + file("camera")));
  EXPECT_TRUE(holds(run.err(), "--wait"));
  EXPECT_TRUE(run.out().empty());
}

TEST_F(CommandRunAlone, WaitsForADeviceIfAsked) {
  FakeCreate wheels(file("wheels"));
  Process run(folder, on_devices({"--wait", "--frames", "30", "--log", "run.log"}));
  ASSERT_TRUE(run.says("camera pixy2 at " + file("camera") + " is absent")) << run.err();
  FakePixy camera(file("camera"));
  EXPECT_EQ(run.wait(), 0) << run.err();
  EXPECT_EQ(count(run.err(), "is absent"), 1U) << run.err();
  expect_replays("run.log", digest_in(run.err()));
}

TEST_F(CommandRun, PartsOfALogAreOneRunAndEachIsARecording) {
  Process run(folder, on_devices({"--log", "run.log", "--log-size", "8K", "--frames", "200"}));
  EXPECT_EQ(run.wait(), 0) << run.err();
  ASSERT_TRUE(std::filesystem::exists(folder.path() / "run-0003.log"));
  for (const char* part : {"run-0002.log", "run-0003.log"}) {
    const std::string text = log(part);
    EXPECT_TRUE(text.starts_with("# the run goes on that began in run.log, profile full\r\n$FPCAM,")) << part;
    EXPECT_EQ(text.find("$FPHDR"), std::string::npos) << part;
    EXPECT_LT(text.find("$FPSIG,1,"), text.find("$FPODO,")) << part;
    EXPECT_LT(text.find("$FPCFG,alert.stop,"), text.find("$FPODO,")) << part;
    const Outcome alone = shell(folder, std::string("fencepost replay ") + part);
    EXPECT_EQ(alone.exit_code, 0) << alone.err;
    EXPECT_TRUE(holds(alone.out, "confirmed"));
  }
  expect_replays("run.log run-*.log", digest_in(run.err()));
}

TEST_F(CommandRunAlone, NeverOverwritesALogUnlessTold) {
  spill(folder.path() / "run.log", "precious");
  const std::string command = "fencepost run --camera console --odometry console --log run.log < /dev/null";
  EXPECT_TRUE(ends(shell(folder, command), 4, "run.log: there is one"));
  EXPECT_EQ(log(), "precious");
  EXPECT_EQ(shell(folder, command + " --force").exit_code, 0);
  EXPECT_NE(log(), "precious");
}

TEST_F(CommandRunAlone, ALogThatCannotBeWrittenDoesNotStopTheRobot) {
  const Outcome full =
      shell(folder, "fencepost run --camera console --odometry console --mode text --log /dev/full < " +
                        recording("approach_stop.log"));
  EXPECT_EQ(full.exit_code, 4);
  EXPECT_TRUE(holds(full.err, "cannot write the log /dev/full: No space left on device"));
  EXPECT_TRUE(holds(full.err, "broken off after"));
  EXPECT_TRUE(holds(full.err, "109 frames"));
  EXPECT_TRUE(holds(full.out, "STOP  "));
}

TEST_F(CommandRunAlone, ALogPlayedIntoTheConsoleGivesItsDigest) {
  const Outcome replay = shell(folder, "fencepost replay " + recording("approach_stop.log"));
  const std::string digest = digest_in(replay.out);
  for (const char* profile : {"full", "small", "micro"}) {
    const Outcome run =
        shell(folder, std::string("fencepost run --camera console --odometry console --profile ") + profile +
                          " --force --log run.log --mode quiet < " + recording("approach_stop.log"));
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(log().find(std::string(",linux,") + profile + "*"), std::string::npos);
    EXPECT_TRUE(std::string(profile) != "full" || digest_in(run.err) == digest) << run.err;
    expect_replays("run.log", digest_in(run.err));
  }
}

TEST_F(CommandRun, AConsoleOnAPtyIsTypedAt) {
  Process run(folder, on_devices({"--console", "pty", "--log", "run.log"}));
  ASSERT_TRUE(run.says("console at /dev/pts/")) << run.err();
  std::smatch match;
  const std::string err = run.err();
  ASSERT_TRUE(std::regex_search(err, match, std::regex("console at (\\S+)")));
  const linux::Descriptor terminal(::open(match[1].str().c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK));
  ASSERT_TRUE(terminal.open());
  ASSERT_EQ(::write(terminal.get(), "version\r", 8), 8);
  std::string heard;
  EXPECT_TRUE(eventually([&] {
    std::array<char, 4096> buffer{};
    const ssize_t size = ::read(terminal.get(), buffer.data(), buffer.size());
    if (size > 0) heard.append(buffer.data(), static_cast<std::size_t>(size));
    return heard.find("fencepost " FENCEPOST_VERSION " for linux, profile full") != std::string::npos &&
           heard.find("camera pixy2 at " + file("camera") + " works") != std::string::npos;
  })) << heard;
  run.signal(SIGTERM);
  EXPECT_EQ(run.wait(), 0);
  EXPECT_TRUE(run.out().empty()) << run.out();
}

// Whether anybody reads its words or not, a robot goes on; what nobody got is said.
TEST_F(CommandRun, AReaderThatLeavesDoesNotEndTheRun) {
  const Outcome run = shell(folder,
                            "{ fencepost run --camera pixy2:./camera --odometry create2:./wheels --robot robot.json "
                            "--mode log --frames 60; echo $? > code; } | head -n 3");
  EXPECT_EQ(log("code"), "4\n") << run.err;
  EXPECT_EQ(count(run.out, "\n"), 3U);
  EXPECT_EQ(count(run.err, "nobody reads standard output any more; the run goes on, its records are lost\n"), 1U)
      << run.err;
  EXPECT_TRUE(holds(run.err, "bytes that the console did not take"));
  EXPECT_FALSE(holds(run.err, " 0 frames"));
}

TEST_F(CommandRun, WithALogNobodyNeedsToRead) {
  const Outcome run = shell(folder,
                            "{ fencepost run --camera pixy2:./camera --odometry create2:./wheels --robot robot.json "
                            "--mode log --log run.log --frames 60; echo $? > code; } | head -n 3");
  EXPECT_EQ(log("code"), "0\n") << run.err;
  EXPECT_EQ(count(run.err, "nobody reads standard output any more; the run and its log go on\n"), 1U) << run.err;
  expect_replays("run.log", digest_in(run.err));
}

// The disk is played by a limit on file size. What it took is the log's beginning, to the byte.
TEST_F(CommandRunAlone, AFullDiskBehindStandardOutputIsCountedAndEndsNothing) {
  const std::string command = "fencepost run --camera console --odometry console < " + recording("approach_stop.log");
  const Outcome all = shell(folder, command + " > all.log");
  EXPECT_EQ(all.exit_code, 0) << all.err;
  const Outcome full = shell(folder, "(ulimit -f 16; " + command + " > full.log)");
  EXPECT_EQ(full.exit_code, 4);
  EXPECT_EQ(count(full.err, "cannot write standard output: File too large"), 1U) << full.err;
  EXPECT_TRUE(holds(full.err, "109 frames"));
  EXPECT_EQ(digest_in(full.err), digest_in(all.err)) << "the loop saw all of it";
  const std::size_t size = log("full.log").size();
  EXPECT_GE(size, 8192U);
  std::smatch lost;
  ASSERT_TRUE(std::regex_search(full.err, lost, std::regex("(\\d+) bytes that the console did not take"))) << full.err;
  EXPECT_NEAR(std::stod(lost[1].str()), static_cast<double>(log("all.log").size() - size), 50)
      << "but for the digits of the loop's longest turn";
  const Outcome device = shell(folder, command + " > /dev/full");
  EXPECT_EQ(device.exit_code, 4);
  EXPECT_TRUE(holds(device.err, "No space left on device; "));
  EXPECT_TRUE(holds(device.err, "109 frames"));
}

/// A log whose disk takes nothing: a pipe with a page of room that nobody reads until `drain`.
class SlowDisk {
 public:
  explicit SlowDisk(std::string path) : path_(std::move(path)) {
    EXPECT_EQ(::mkfifo(path_.c_str(), 0600), 0);
    reader_ = linux::Descriptor(::open(path_.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
    EXPECT_GT(::fcntl(reader_.get(), F_SETPIPE_SZ, 4096), 0);
  }
  /// Takes everything, from now until the run has ended, and answers it.
  std::string drain(Process& run) {
    std::string all;
    std::array<char, 4096> page{};
    EXPECT_TRUE(eventually([&] {
      const bool ended = run.ended();
      ssize_t count = 0;
      while ((count = ::read(reader_.get(), page.data(), page.size())) > 0)
        all.append(page.data(), static_cast<std::size_t>(count));
      return ended;
    }));
    return all;
  }

 private:
  std::string path_;
  linux::Descriptor reader_;
};

TEST_F(CommandRun, ADiskThatStandsStillCostsTheLoopNothing) {
  SlowDisk disk(file("slow"));
  Process run(folder, on_devices({"--log", "slow", "--mode", "log"}));
  ASSERT_TRUE(run.says("the disk of the log slow has taken nothing for 2 s")) << run.err();
  const std::size_t frames = count(run.out(), "$FPFRM,");
  ASSERT_TRUE(eventually([&] { return count(run.out(), "$FPFRM,") >= frames + 100; })) << "it goes on: " << run.err();
  run.signal(SIGTERM);
  spill(folder.path() / "drained", disk.drain(run));
  EXPECT_EQ(run.wait(), 0) << run.err();
  EXPECT_FALSE(holds(run.err(), "queue")) << "no input was refused for want of room: " << run.err();
  EXPECT_FALSE(holds(run.err(), "silent")) << "the camera is not to blame: " << run.err();
  expect_replays("drained", digest_in(run.err()));
}

// The loop ends in time; the disk is then waited for, which is said.
TEST_F(CommandRun, ASlowDiskDoesNotLengthenTheRun) {
  SlowDisk disk(file("slow"));
  Process run(folder, on_devices({"--log", "slow", "--mode", "quiet", "--seconds", "2"}));
  ASSERT_TRUE(run.says("the disk of the log slow has taken nothing for 2 s")) << run.err();
  spill(folder.path() / "drained", disk.drain(run));
  EXPECT_EQ(run.wait(), 0) << run.err();
  EXPECT_TRUE(std::regex_search(run.err(), std::regex("\\n2\\.0 s: "))) << run.err();
  expect_replays("drained", digest_in(run.err()));
}

// It has time: more than the queue holds waits for the disk, and nothing of it is refused.
TEST_F(CommandRunAlone, ARecordedStreamWaitsForTheDisk) {
  constexpr int kSamples = 40'000;
  std::string stream;
  for (int i = 1; i <= kSamples; ++i) {
    std::array<char, record::kMaxLine> line{};
    const sensor::OdometrySample sample{base::Time{200 * i}, {}, {}, {}};
    stream.append(line.data(), record::encode(sample, line));
  }
  ASSERT_GT(stream.size(), WriteBehind::kCapacity + 300'000U) << "more than the queue and the journal hold";
  spill(folder.path() / "stream", stream);
  SlowDisk disk(file("slow"));
  Process run(folder, {"run", "--camera", "console", "--odometry", "console", "--log", "slow", "--mode", "quiet"});
  std::thread typist([&] { run.type(stream), run.hang_up(); });
  ASSERT_TRUE(run.says("the disk of the log slow is too slow")) << run.err();
  const std::string log = disk.drain(run);
  typist.join();
  EXPECT_EQ(run.wait(), 0) << run.err();
  EXPECT_EQ(count(log, "$FPODO,"), static_cast<std::size_t>(kSamples)) << run.err();
}

// Blind until the first frame is used, then clear, notice and what follows; and blind again when nobody looks any more.
TEST_F(CommandRun, RunsACommandAtEachChangeOfTheLevel) {
  Process run(folder, on_devices({"--log", "run.log", "--mode", "quiet", "--on-alert",
                                  "echo $1 $FENCEPOST_ID $FENCEPOST_COLOUR >> levels; echo shown"}));
  ASSERT_TRUE(eventually([&] { return slurp(folder.path() / "levels").find("notice ") != std::string::npos; }));
  run.signal(SIGINT);
  EXPECT_EQ(run.wait(), 130) << run.err();
  const std::string levels = slurp(folder.path() / "levels");
  EXPECT_TRUE(std::regex_match(levels, std::regex("blind\nclear\n(.*\n)*notice \\d+ red\n(.*\n)*blind\n"))) << levels;
  EXPECT_TRUE(run.out().empty()) << "its output is none of the run's: " << run.out();
  EXPECT_TRUE(holds(run.err(), "shown\n"));
  expect_replays("run.log", digest_in(run.err()));
}

TEST_F(CommandRun, ACommandThatHangsOrFailsCostsTheLoopNothing) {
  Process run(folder, on_devices({"--log", "run.log", "--mode", "quiet", "--on-alert",
                                  "echo $1 >> levels; if [ $1 = clear ]; then sleep 100; else exit 7; fi"}));
  ASSERT_TRUE(run.says("the command for level blind ended with exit code 7")) << run.err();
  ASSERT_TRUE(eventually([&] { return slurp(folder.path() / "levels").find("clear") != std::string::npos; }));
  const std::size_t frames = count(log(), "$FPFRM,");
  ASSERT_TRUE(logs("$FPFRM,", frames + 20));
  EXPECT_FALSE(holds(run.err(), "was killed")) << "it went on meanwhile: " << run.err();
  ASSERT_TRUE(run.says("the command for level clear still ran after 2.0 s and was killed")) << run.err();
  run.signal(SIGTERM);
  EXPECT_EQ(run.wait(), 0) << run.err();
  EXPECT_FALSE(holds(run.err(), "silent"));
  expect_replays("run.log", digest_in(run.err()));
}

/// A Create that `run` drives straight at the post, and a camera that sees the way it comes.
class CommandRunDriving : public CommandRunAlone {
 protected:
  [[nodiscard]] Process start() const {
    return Process(
        folder, {"run", "--camera", "pixy2:" + file("camera"), "--odometry", "create2:" + file("wheels") + ",drive=200",
                 "--robot", "robot.json", "--log", "run.log", "--mode", "quiet"});
  }
  /// The ways of the odometry in `text`, m.
  static std::vector<double> ways(const std::string& text) {
    std::vector<double> all;
    for (std::size_t at = text.find("$FPODO,"); at != std::string::npos; at = text.find("$FPODO,", at + 1))
      all.push_back(std::stod(text.substr(text.find(',', at + 7) + 1)));
    return all;
  }
  FakeCreate wheels{file("wheels")};
  FakePixy camera{file("camera"), [this](base::Time) { return wheels.driven_way(); }};
};

TEST_F(CommandRunDriving, StopsAtTheStopAndStands) {
  Process run = start();
  ASSERT_TRUE(eventually([&] { return wheels.speed() == 200; })) << run.err();
  ASSERT_TRUE(eventually([&] { return wheels.speed() == 0; })) << run.err();
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  EXPECT_EQ(wheels.speed(), 0);
  EXPECT_GT(wheels.driven_way(), 0.3) << "it drove";
  EXPECT_LT(wheels.driven_way(), 0.85) << "its front is half of 0.2 m before it, and the post 1 m ahead";
  run.signal(SIGINT);
  EXPECT_EQ(run.wait(), 130) << run.err();
  const std::string text = log();
  const std::size_t stop = text.find(",stop,");
  ASSERT_NE(stop, std::string::npos);
  const std::vector<double> before = ways(text.substr(0, stop));
  const std::vector<double> after = ways(text.substr(stop));
  ASSERT_GT(after.size(), 10U);
  // 200 mm/s: a frame of the stream on its way, the stop on its way, a count.
  EXPECT_LT(after.back() - before.back(), 0.2 * 0.05) << "within 50 ms of the record";
  expect_replays("run.log", digest_in(run.err()));
}

TEST_F(CommandRunDriving, StandsWhileTheCameraIsAwayAndAtTheEnd) {
  Process run = start();
  ASSERT_TRUE(eventually([&] { return wheels.speed() == 200; })) << run.err();
  camera.device().unplug();
  ASSERT_TRUE(eventually([&] { return wheels.speed() == 0; })) << run.err();
  camera.device().plug();
  ASSERT_TRUE(eventually([&] { return wheels.speed() == 200; })) << run.err();
  EXPECT_EQ(wheels.mode(), 2);
  run.signal(SIGINT);
  EXPECT_EQ(run.wait(), 130) << run.err();
  EXPECT_TRUE(eventually([&] { return wheels.speed() == 0 && wheels.mode() == 1; })) << "it stands, in passive";
}

TEST_F(CommandRun, DrivesNothingUnlessAskedTo) {
  Process run(folder, on_devices({"--log", "run.log", "--frames", "60"}));
  EXPECT_EQ(run.wait(), 0) << run.err();
  EXPECT_EQ(wheels.mode(), 1) << "passive";
  EXPECT_EQ(wheels.driven_way(), 0);
}

#ifdef FENCEPOST_FAKE_GPIOD
/// The program's libgpiod is the test's: its levels are lines of the file `levels`, "SECONDS LEVEL".
class CommandRunWithALine : public CommandRunAlone {
 protected:
  [[nodiscard]] Process start() const {
    ::setenv("LD_PRELOAD", (FENCEPOST_FAKE_GPIOD ":" + before).c_str(), 1);
    ::setenv("FAKE_GPIO", file("levels").c_str(), 1);
    ::setenv("ASAN_OPTIONS", "verify_asan_link_order=0", 0);
    const std::vector<std::string> words =
        on_devices({"--log", "run.log", "--mode", "quiet", "--stop-gpio", "gpiochip0:3"});
    return Process(folder, words);
  }
  void TearDown() override { ::setenv("LD_PRELOAD", before.c_str(), 1); }
  /// The levels so far, without repetitions: "010".
  [[nodiscard]] std::string levels() const {
    std::ifstream file(folder.path() / "levels");
    std::string all;
    double time = 0;
    for (std::string level; file >> time >> level;) {
      if (all.empty() || all.back() != level.front()) all += level;
    }
    return all;
  }
  [[nodiscard]] bool goes_through(const std::string& expected) const {
    return eventually([&] { return levels().starts_with(expected); });
  }

  const char* preloaded = ::getenv("LD_PRELOAD");
  std::string before = preloaded != nullptr ? preloaded : "";
};

TEST_F(CommandRunWithALine, IsHighOnlyWhileBothSensorsWork) {
  FakePixy camera(file("camera"));
  FakeCreate wheels(file("wheels"));
  Process run = start();
  ASSERT_TRUE(goes_through("01")) << levels() << run.err();
  camera.device().unplug();
  ASSERT_TRUE(goes_through("010")) << levels();
  camera.device().plug();
  ASSERT_TRUE(goes_through("0101")) << levels();
  run.signal(SIGINT);
  EXPECT_EQ(run.wait(), 130) << run.err();
  EXPECT_EQ(levels(), "01010") << "at the end, too";
  expect_replays("run.log", digest_in(run.err()));
}

TEST_F(CommandRunWithALine, StaysLowWithoutACameraAndFallsWhenTheProgramIsKilled) {
  FakeCreate wheels(file("wheels"));
  {
    Process missing = start();
    EXPECT_EQ(missing.wait(), 4);
    EXPECT_EQ(levels(), "0");
  }
  FakePixy camera(file("camera"));
  Process run = start();
  ASSERT_TRUE(goes_through("01")) << levels() << run.err();
  run.signal(SIGKILL);
  run.wait();
  EXPECT_TRUE(goes_through("010")) << levels();
}

TEST_F(CommandRunWithALine, FallsWhileTheProgramIsHeldUp) {
  FakePixy camera(file("camera"));
  FakeCreate wheels(file("wheels"));
  Process run = start();
  ASSERT_TRUE(goes_through("01")) << levels() << run.err();
  run.signal(SIGSTOP);
  EXPECT_TRUE(goes_through("010")) << levels();
  run.signal(SIGCONT);
  EXPECT_TRUE(goes_through("0101")) << levels();
  EXPECT_EQ(run.end(SIGTERM), 0) << run.err();
}
#endif

TEST_F(CommandRun, NeedsNoStandardStreams) {
  const Outcome run = shell(folder,
                            "fencepost run --camera console --odometry create2:./wheels --seconds 0.5 --log run.log "
                            "<&- >&- 2>&-");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_GT(count(log(), "$FPODO,"), 10U);
}

TEST_F(CommandRun, StopsAfterSomeSeconds) {
  EXPECT_TRUE(ends(shell(folder, "fencepost run --camera console --odometry create2:./wheels --seconds 0.5"), 0,
                   " s: 0 frames, "));
}

TEST_F(CommandRunAlone, SaysWhatIsWrongWithItsArguments) {
  const std::pair<std::string, std::string> kWrong[] = {
      {"--camera pixi2:/dev/x --odometry console", "did you mean pixy2?"},
      {"--camera console --odometry pixy2:/dev/x", "pixy2 is for --camera"},
      {"--camera console --odometry console --console COM3", "allowed: - (this terminal), pty"},
      {"--camera console --odometry console --log-size 64M", "name a file"},
      {"--camera console --odometry console --log x --log-size many", "write 4K, 64M or 2G"},
      {"--camera console --odometry console --log x --log-size 4095", "write 4K, 64M or 2G"},
      {"--camera console --odometry console --log -", "--mode log"},
      {"--camera cmucam2:/dev/x --odometry console", "tracks no colour yet"},
      {"--camera console --odometry can:can0", "add \"can\" to a --robot file"},
      {"--camera nxtcam:nxt --odometry console", "add --odometry nxt:usb"},
      {"--camera pixy2:/dev/x --odometry create2:/dev/x", "cannot both have that port"},
      {"--camera console --odometry console --stop-gpio 17", "such as gpiochip0:17"},
      {"--camera console --odometry console --alert-can can0:12", "such as can0 or can0:120"},
  };
  for (const auto& [arguments, message] : kWrong) {
    const Outcome run = shell(folder, "fencepost run " + arguments);
    EXPECT_EQ(run.exit_code, 2) << arguments;
    EXPECT_TRUE(holds(run.err, message));
    EXPECT_TRUE(run.out.empty());
  }
  EXPECT_TRUE(ends(shell(folder,
                         "echo '{\"camra\": {}}' > r.json; fencepost run --camera console --odometry console "
                         "--robot r.json"),
                   3, "r.json: /camra: unknown key"));
}

}  // namespace
}  // namespace fencepost::host::testing
