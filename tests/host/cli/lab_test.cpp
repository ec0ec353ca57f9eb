// The second program, which the first one starts: where it is, and where it is not.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "tests/host/cli/run.hpp"

namespace fencepost::host {
namespace {

namespace fs = std::filesystem;

using namespace testing;

const fs::path kLab = fs::path(FENCEPOST_EXE).parent_path() / "fencepost-lab";

/// A copy of the first program alone, as `toolchain/demo` leaves it.
class Alone : public ::testing::Test {
 protected:
  Alone() {
    fs::create_directories(folder_.path() / "bin");
    fs::copy_file(FENCEPOST_EXE, folder_.path() / "bin/fencepost");
  }
  [[nodiscard]] Outcome run(const std::string& line) const { return shell(folder_, line); }
  Folder folder_;
};

TEST_F(Alone, SaysWhatIsMissingAndHowToGetIt) {
  const std::string log = recording("stop_pixy2.log");
  for (const std::string& line :
       {"merge " + log, "smooth " + log, "calibrate " + log, std::string("paper"), std::string("import rings x.csv"),
        std::string("import mrclam x"), std::string("import kitti x"), std::string("import dlr x"),
        std::string("import cycloid x"), std::string("import victoria x"), "export --format png " + log + " -o x.png",
        "evaluate --smooth " + log + " --scene " + recording("stop_pixy2.json"),
        std::string("segment photos --camera x.json")}) {
    const Outcome run = this->run("bin/fencepost " + line);
    EXPECT_EQ(run.exit_code, 3) << line << "\n" << run.err;
    EXPECT_EQ(run.out, "") << line;
    EXPECT_TRUE(holds(run.err, "needs fencepost-lab"));
    EXPECT_NE(run.err.find("nor in " + (folder_.path() / "libexec/fencepost").string() + ";"), std::string::npos)
        << run.err;
    EXPECT_TRUE(holds(run.err, "toolchain/setup host lab && cmake --preset demo"));
    EXPECT_TRUE(run.err.ends_with("cmake --install build/demo --prefix '" + folder_.path().string() + "'\n"))
        << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1);
  }
}

TEST_F(Alone, InstallsNothingWhereItWasBuilt) {
  fs::rename(folder_.path() / "bin", folder_.path() / "cli");
  EXPECT_TRUE(run("cli/fencepost paper").err.ends_with("&& cmake --build --preset demo\n"));
}

TEST_F(Alone, SaysInHelpWhatTheOtherDoes) {
  const std::string overview = run("bin/fencepost --help").out;
  EXPECT_NE(overview.find("\n  paper *     "), std::string::npos) << overview;
  EXPECT_NE(overview.find("\n  replay      "), std::string::npos) << overview;
  EXPECT_NE(overview.find("* by a second program, fencepost-lab"), std::string::npos) << overview;
  for (const char* command : {"paper", "segment", "merge", "calibrate", "smooth", "import rings", "import mrclam",
                              "import kitti", "import dlr", "import cycloid", "import victoria"}) {
    EXPECT_NE(run(std::string("bin/fencepost help ") + command).out.find("fencepost-lab"), std::string::npos)
        << command;
  }
  EXPECT_EQ(run("bin/fencepost help replay").out.find("fencepost-lab"), std::string::npos);
}

TEST_F(Alone, KnowsEveryCommandAllTheSame) {
  EXPECT_EQ(run("bin/fencepost help smooth").out, run("fencepost help smooth").out);
  EXPECT_EQ(run("bin/fencepost completion bash").out, run("fencepost completion bash").out);
  EXPECT_EQ(run("bin/fencepost smooth --jsno x").exit_code, 2);
  EXPECT_EQ(run("bin/fencepost evaluate " + recording("stop_pixy2.log")).exit_code, 0);
}

TEST_F(Alone, ReadsNothingBeforeItSays) {
  EXPECT_EQ(run("{ echo first; echo second; } | { bin/fencepost merge -; cat; }").out, "first\nsecond\n");
}

TEST_F(Alone, SaysWhatCannotBeStarted) {
  testing::spill(folder_.path() / "bin/fencepost-lab", "no program");
  const Outcome run = this->run("bin/fencepost merge x.log");
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_NE(run.err.find("cannot start " + (folder_.path() / "bin/fencepost-lab").string()), std::string::npos)
      << run.err;
}

TEST_F(Alone, FindsTheOtherBesideItselfAndInLibexec) {
  ASSERT_TRUE(fs::exists(kLab)) << kLab;
  const std::string line = "bin/fencepost merge - 'no such file' < " + recording("stop_pixy2.log");
  const fs::path libexec = folder_.path() / "libexec/fencepost";
  fs::create_directories(libexec);
  fs::create_symlink(kLab, libexec / "fencepost-lab");
  for (const fs::path& place : {libexec, folder_.path() / "bin"}) {
    if (place != libexec) fs::rename(libexec / "fencepost-lab", place / "fencepost-lab");
    const Outcome run = this->run(line);
    EXPECT_EQ(run.exit_code, 3);
    EXPECT_TRUE(holds(run.err, "no such file"));
    EXPECT_FALSE(holds(run.err, "fencepost-lab"));
  }
}

}  // namespace
}  // namespace fencepost::host
