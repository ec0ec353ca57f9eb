// `fencepost record --camera --odometry` on emulated devices.
#include <gtest/gtest.h>

#include <csignal>

#include "tests/hal/linux/pty.hpp"
#include "tests/host/end_to_end/stage.hpp"
#include "tests/host/end_to_end/terminal.hpp"

namespace fencepost::host::testing {
namespace {

TEST(EndToEndRecord, DevicesAreRecordedInPartsThatAreOneRun) {
  const Folder folder;
  spill(folder.path() / "scene.json", scene_for(camera_of("pixy2:./a"), 12, 0.6));
  Process emulate(folder, {"emulate", "pixy2", "records", "scene.json", "--link", "a", "--link", "b"}, "emulate.");
  ASSERT_TRUE(eventually([&] { return std::filesystem::exists(folder.path() / "b"); })) << emulate.err();
  Process record(folder,
                 {"record", "--camera", "pixy2:./a", "--odometry", "records:./b", "--robot", "scene.json", "-o",
                  "part.log", "--log-size", "8K"},
                 "record.");
  EXPECT_EQ(emulate.wait(), 0) << emulate.err();
  EXPECT_EQ(record.end(SIGINT), 130) << record.err();
  EXPECT_EQ(record.out(), "");
  EXPECT_NE(record.err().find("log part.log to part-000"), std::string::npos) << record.err();
  ASSERT_TRUE(std::filesystem::exists(folder.path() / "part-0002.log"));
  EXPECT_EQ(shell(folder, "cat part.log part-*.log > run.log").exit_code, 0);
  expect_replays(folder, record.err());
  expect_things(folder, camera_of("pixy2:./a"), 0.01);
}

// The first Ctrl-C has the file closed and waits for the terminal, which takes nothing any more; the second ends that.
TEST(EndToEndRecord, ASecondInterruptGivesTheTerminalBack) {
  const Folder folder;
  linux::FarEnd far((folder.path() / "tty").string());
  Terminal terminal(folder, {"record", "./tty", "-o", "run.log", "--no-command"});
  ASSERT_TRUE(terminal.shows("Ctrl-C ends it")) << terminal.text();
  ASSERT_TRUE(eventually([&] { return !terminal.echoes(); })) << "what is typed stands in the status line";
  const std::string line(2'000, 'x');
  for (std::size_t lines = 1; lines <= 60; ++lines) {
    far.say(line + "\n");
    ASSERT_TRUE(eventually([&] { return slurp(folder.path() / "run.log").size() >= lines * (line.size() + 1); }));
  }
  terminal.type("\x03");
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  terminal.type("\x03");
  EXPECT_EQ(terminal.wait(), 1000 + SIGINT) << "the second one ended it";
  EXPECT_TRUE(terminal.echoes());
}

}  // namespace
}  // namespace fencepost::host::testing
