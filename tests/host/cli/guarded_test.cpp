// Whatever a command throws, the program ends with a message and an exit code.
#include "host/cli/guarded.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <new>
#include <regex>
#include <stdexcept>

#include "host/cli/exit_code.hpp"
#include "tests/host/cli/run.hpp"

namespace fencepost::host::cli {
namespace {

struct Ending {
  int code;
  std::string message;
};

Ending end_of(const std::function<int()>& command) {
  ::testing::internal::CaptureStderr();
  const int code = guarded(command);
  return {code, ::testing::internal::GetCapturedStderr()};
}

TEST(Guarded, ACommandThatThrowsNothingHasItsOwnExitCode) {
  const Ending ending = end_of([] { return 1; });
  EXPECT_EQ(ending.code, 1);
  EXPECT_EQ(ending.message, "");
}

TEST(Guarded, AFailureSaysItself) {
  const Ending ending = end_of([]() -> int { throw Failure(Exit::kDevice, "no \x1b[2Jport; plug it in"); });
  EXPECT_EQ(ending.code, 4);
  EXPECT_EQ(ending.message, "fencepost: no ?[2Jport; plug it in\n");
}

TEST(Guarded, WhatNobodyForesawIsUnreadableInput) {
  const Ending range = end_of([]() -> int { throw std::out_of_range("number overflow"); });
  EXPECT_EQ(range.code, 3);
  EXPECT_NE(range.message.find("number overflow; please report it"), std::string::npos) << range.message;
  const Ending memory = end_of([]() -> int { throw std::bad_alloc(); });
  EXPECT_EQ(memory.code, 3);
  EXPECT_NE(memory.message.find("give it a part of the input"), std::string::npos) << memory.message;
  const Ending path = end_of([]() -> int {
    throw std::filesystem::filesystem_error("status", "some/place", std::make_error_code(std::errc::permission_denied));
  });
  EXPECT_EQ(path.code, 3);
  EXPECT_EQ(path.message, "fencepost: cannot read some/place: Permission denied; check the path\n");
}

TEST(Guarded, ARefusalOfTheSystemIsOfADevice) {
  const Ending ending =
      end_of([]() -> int { throw std::system_error(std::make_error_code(std::errc::resource_unavailable_try_again)); });
  EXPECT_EQ(ending.code, 4);
  EXPECT_NE(ending.message.find("Resource temporarily unavailable"), std::string::npos) << ending.message;
}

using host::testing::anybody_can_run;
using host::testing::as_anybody;
using host::testing::Outcome;
using host::testing::recording;
using host::testing::shell;

// Each of these once ended a command by SIGABRT.
TEST(NoCommandAborts, WhateverANumberSays) {
  shell("sed 's/\"seed\": *[0-9]*/\"seed\": 1e999/' " + recording("approach_stop.json") +
        " > s.json; echo '{\"camera\": {\"fx\": -1e999}}' > r.json; : > m.json");
  for (const char* line :
       {"simulate s.json", "report s.json --scene s.json", "emulate pixy2 s.json", "evaluate run.log --scene s.json",
        "run --camera console --odometry console --robot s.json", "replay run.log --camera s.json"}) {
    const Outcome run = shell(std::string("cp ") + recording("approach_stop.log") + " run.log; fencepost " + line);
    EXPECT_EQ(run.exit_code, 3) << line << ": " << run.err;
    EXPECT_TRUE(std::regex_search(run.err, std::regex("s.json: line [0-9]+, column [0-9]+: this number"))) << run.err;
  }
  EXPECT_TRUE(
      ends(shell("fencepost run --camera console --odometry console --robot r.json"), 3, "r.json: line 1, column 19"));
}

TEST(NoCommandAborts, WhateverANameIs) {
  const std::string name(5000, 'n');
  for (const std::string& line :
       {"evaluate " + name, "evaluate " + name + ".log", "replay " + name, "replay - --camera " + name,
        "report x.log --scene " + name, "simulate " + name, "emulate pixy2 " + name, "import rings " + name,
        "import mrclam " + name + " --robot 1", "segment " + name + " --camera " + name}) {
    const Outcome run = shell("fencepost " + line);
    EXPECT_EQ(run.exit_code, 3) << line.substr(0, 30) << run.err;
    EXPECT_TRUE(holds(run.err, "nnn"));
  }
  for (const std::string& line :
       {"record - -o " + name, "run --camera console --odometry console --log " + name, "paper -o " + name}) {
    const Outcome run = shell("fencepost " + line);
    EXPECT_EQ(run.exit_code, 4) << line.substr(0, 30) << run.err;
    EXPECT_TRUE(holds(run.err, "File name too long"));
  }
}

// The name fits, the names of later parts do not.
TEST(NoCommandAborts, WhenAPartOfALogCannotBeNamed) {
  const std::string name = std::string(251, 'n') + ".log";
  const Outcome run = shell("fencepost run --camera console --odometry console --mode quiet --log-size 4K --log " +
                            name + " < " + recording("approach_stop.log"));
  EXPECT_EQ(run.exit_code, 4);
  EXPECT_TRUE(holds(run.err, "File name too long"));
  EXPECT_TRUE(holds(run.err, "broken off after"));
  EXPECT_TRUE(holds(run.err, "109 frames"));
}

TEST(NoCommandAborts, WhereAFolderMayNotBeEntered) {
  if (!anybody_can_run()) GTEST_SKIP() << "only root may run the program where it was built";
  EXPECT_TRUE(
      ends(shell(as_anybody() + "mkdir d; chmod 0 d; fencepost evaluate d/n.log"), 3, "d/n.json: Permission denied"));
  EXPECT_TRUE(ends(shell(as_anybody() + "chmod 755 d; cd d; chmod 0 .; fencepost record -"), 4, "Permission denied"));
}

// Messages quote what files and robots say.
TEST(Messages, ShowNoControlCharacters) {
  const std::string escape = "\\033[31m\\302\\233x\\233y";
  const Outcome scene = shell("printf '{\"format\": 1, \"a" + escape + "\": 1}' > s.json; " +
                              "printf '$FPHDR,1,a,b,c,\\033]0;full*0000\\r\\n' > x.log; " +
                              "fencepost simulate s.json; fencepost replay x.log");
  EXPECT_NE(scene.err, "");
  EXPECT_EQ(scene.err.find_first_of("\x1b\x9b"), std::string::npos) << scene.err;
}

}  // namespace
}  // namespace fencepost::host::cli
