// `fencepost run` as a process in the guest, and what its log holds.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <regex>
#include <string>
#include <vector>

#include "tests/host/cli/process.hpp"
#include "tests/text.hpp"

namespace fencepost::guest {

using test::count;

class LiveRun : public testing::Test {
 protected:
  using Process = host::testing::Process;

  LiveRun() {
    write("robot.json",
          R"({"camera": {"mount": {"z": 0.12}}, "signatures": [{"id": 1, "name": "red", "rgb": "d02020"}]})");
  }

  void write(const std::string& name, const std::string& text) { host::testing::spill(folder.path() / name, text); }
  void start(const std::string& camera, const std::string& odometry, const std::vector<std::string>& more = {}) {
    std::vector<std::string> words = {"run",        "--camera", camera,    "--odometry", odometry, "--robot",
                                      "robot.json", "--log",    "run.log", "--mode",     "quiet",  "--wait"};
    words.insert(words.end(), more.begin(), more.end());
    run.emplace(folder, words);
  }
  [[nodiscard]] std::string log() const { return host::testing::slurp(folder.path() / "run.log"); }
  [[nodiscard]] bool logs(const std::string& part, std::size_t times = 1) const {
    return host::testing::eventually([&] { return count(log(), part) >= times; });
  }
  /// New frames and new odometry come.
  void expect_flow(const std::string& when) {
    const std::string before = log();
    EXPECT_TRUE(logs("$FPODO,", count(before, "$FPODO,") + 5)) << when << ": no odometry\n" << run->err();
    EXPECT_TRUE(logs("$FPFRM,", count(before, "$FPFRM,") + 3)) << when << ": no frames\n" << run->err();
  }
  /// The x of the last odometry in the log, m.
  [[nodiscard]] double x() const {
    const std::string text = log();
    const std::size_t line = text.rfind("$FPODO,", text.rfind('\n'));
    if (line == std::string::npos) return 0;
    return std::strtod(text.c_str() + text.find(',', line + 7) + 1, nullptr);
  }
  [[nodiscard]] bool arrives_at(double way, double tolerance) const {
    return host::testing::eventually([&] { return x() > way - tolerance && x() < way + tolerance; });
  }
  [[nodiscard]] std::size_t said(const std::string& sentence) const { return count(run->err(), sentence); }

  /// Ended by Ctrl-C, the run tells its digest, and its log replays to the same.
  void expect_replays() {
    run->signal(SIGINT);
    EXPECT_EQ(run->wait(), 130) << run->err();
    const host::testing::Outcome replay = host::testing::shell(folder, "fencepost replay --check run.log");
    EXPECT_EQ(replay.exit_code, 0) << replay.err;
    EXPECT_EQ(digest_in(replay.out), digest_in(run->err()));
  }

  host::testing::Folder folder;
  std::optional<Process> run;

 private:
  static std::string digest_in(const std::string& text) {
    std::smatch match;
    EXPECT_TRUE(std::regex_search(text, match, std::regex("digest ([0-9a-f]{16})"))) << text;
    return match.empty() ? "" : match[1].str();
  }
};

}  // namespace fencepost::guest
