// The memory that long logs take: bytes at the peak, of the program as a process.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>
#include <vector>

#include "tests/host/cli/run.hpp"
#include "tests/studies/memory/long_log.hpp"

namespace fencepost::host {
namespace {

using testing::Folder;
using testing::LongLog;
using testing::slurp;
using testing::spill;
using testing::write_long_log;

constexpr std::uint64_t kMegabyte = 1'000'000;
constexpr double kSame = 2;  ///< MB
constexpr double kMax = 48;  ///< MB, whatever the log

struct Ended {
  int exit_code = -1;
  double peak = 0;  ///< MB
};

/// `fencepost words...` in `folder`, with its output in the file `out` there. It may have `limit` KB of addresses.
Ended run(const Folder& folder, std::vector<std::string> words, int in = -1, std::uint64_t limit = 0) {
  const std::string most = limit > 0 ? std::to_string(limit) : "unlimited";
  words.insert(words.begin(), {"sh", "-c", "ulimit -v " + most + "; exec \"$0\" \"$@\"", FENCEPOST_EXE});
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t first;
  ::posix_spawn_file_actions_init(&first);
  ::posix_spawn_file_actions_addchdir_np(&first, folder.path().c_str());
  ::posix_spawn_file_actions_addopen(&first, STDOUT_FILENO, "out", O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (in >= 0) ::posix_spawn_file_actions_adddup2(&first, in, STDIN_FILENO);
  pid_t pid = -1;
  EXPECT_EQ(::posix_spawn(&pid, "/bin/sh", &first, nullptr, arguments.data(), environ), 0);
  ::posix_spawn_file_actions_destroy(&first);
  int status = 0;
  rusage used{};
  EXPECT_EQ(::wait4(pid, &status, 0, &used), pid);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, static_cast<double>(used.ru_maxrss) * 1024 / 1e6};
}

bool can_measure() {
#ifdef __SANITIZE_ADDRESS__
  return false;
#else
  return true;
#endif
}

const std::string kScene =
    R"({"format": 1, "seed": 1, "camera": {"width": 316, "height": 208, "fx": 273.6, "fy": 273.6, "cx": 157.5, "cy": 103.5},
"signatures": [{"id": 1, "name": "red", "rgb": "d02020"}], "objects": [{"name": "box", "signature": 1, "height": 0.2,
"footprint": {"type": "Polygon", "coordinates": [[[2, -0.05], [2.1, -0.05], [2.1, 0.05], [2, 0.05], [2, -0.05]]]}}]})";

TEST(Memory, DoesNotGrowWithTheLog) {
  if (!can_measure()) GTEST_SKIP() << "a sanitizer has its own memory";
  const Folder folder;
  write_long_log((folder.path() / "once.log").string(), 30 * kMegabyte);
  write_long_log((folder.path() / "twice.log").string(), 60 * kMegabyte);
  spill(folder.path() / "scene.json", kScene);
  for (const std::vector<std::string>& command : {std::vector<std::string>{"replay", "--json", "--write-log", "own"},
                                                  {"replay", "--check"},
                                                  {"evaluate", "--scene", "scene.json"},
                                                  {"doctor", "--json"},
                                                  {"report", "--static", "-o", "report.html"},
                                                  {"report", "-o", "report.html"},
                                                  {"export", "--format", "svg"}}) {
    SCOPED_TRACE(command[0] + " " + command[1]);
    std::array<double, 2> peaks{};
    for (const std::size_t i : {0U, 1U}) {
      std::vector<std::string> words = command;
      words.insert(words.begin() + 1, i == 0 ? "once.log" : "twice.log");
      const Ended ended = run(folder, words);
      EXPECT_EQ(ended.exit_code, command[1] == "--check" ? 1 : 0);
      peaks[i] = ended.peak;
    }
    EXPECT_LT(peaks[1] - peaks[0], kSame) << peaks[0] << " and " << peaks[1] << " MB";
    EXPECT_LT(peaks[1], kMax);
    if (command[0] == "report") {
      EXPECT_LT(std::filesystem::file_size(folder.path() / "report.html"), 2 * kMegabyte);
    }
    if (command[0] == "replay" && command[1] == "--json") {
      const auto document = nlohmann::json::parse(slurp(folder.path() / "out"));
      EXPECT_GT(document["alerts"].size(), 5'000U) << "the log has to be of the kind that fills memory";
      EXPECT_GT(document["path"].size(), 1'000U);
      EXPECT_LE(document["path"].size(), 2'000U);
      EXPECT_EQ(document["log"]["rejected"]["crc"], 0);
    }
  }
}

/// The command with one line of `bytes`, then 10 s of a drive, at its standard input.
Ended run_behind_a_long_line(const Folder& folder, const std::vector<std::string>& words, std::uint64_t bytes,
                             std::uint64_t limit = 0) {
  std::array<int, 2> pipe{};
  EXPECT_EQ(::pipe2(pipe.data(), O_CLOEXEC), 0);
  std::thread writer([to = pipe[1], bytes] {
    const auto write_all = [to](std::string_view text) {
      while (!text.empty()) {
        const ssize_t written = ::write(to, text.data(), text.size());
        if (written <= 0) return false;
        text.remove_prefix(static_cast<std::size_t>(written));
      }
      return true;
    };
    const std::string part(1U << 16U, 'x');
    bool reads = true;
    for (std::uint64_t size = 0; reads && size < bytes; size += part.size()) reads = write_all(part);
    if (reads) write_all("\n" + LongLog::begin());
    LongLog log;
    for (int i = 0; reads && i < 100; ++i) write_all(log.next());
    ::close(to);
  });
  const Ended ended = run(folder, words, pipe[0], limit);
  ::close(pipe[0]);
  writer.join();
  return ended;
}

/// The commands that read logs, and their exit status with such a one.
const std::vector<std::pair<std::vector<std::string>, int>> kReaders = {
    {{"replay", "-", "--json"}, 0},
    {{"replay", "-", "--check"}, 1},
    {{"replay", "--diff", "-", "short.log"}, 1},
    {{"evaluate", "-", "--scene", "scene.json"}, 0},
    {{"report", "-", "-o", "r.html"}, 0},
    {{"report", "-", "--static", "-o", "r.html"}, 0},
    {{"doctor", "-"}, 0},
    {{"export", "-", "-o", "map.geojson"}, 0},
    {{"export", "-", "-o", "run.csv"}, 3},
    {{"export", "-", "-o", "run.mcap"}, 3},
    {{"calibrate", "-"}, 3},
    {{"smooth", "-"}, 0},
    {{"merge", "-", "short.log"}, 1},
    {{"emulate", "records", "-", "--link", "./robot"}, 3}};

TEST(Memory, ALineWithoutEndIsSkippedOrRefusedByAllThatReadLogs) {
  if (!can_measure()) GTEST_SKIP() << "a sanitizer has its own memory";
  ::signal(SIGPIPE, SIG_IGN);  // a log that is refused is not read to its end
  const Folder folder;
  write_long_log((folder.path() / "short.log").string(), kMegabyte / 2);
  spill(folder.path() / "scene.json", kScene);
  constexpr std::uint64_t kLine = 200 * kMegabyte;
  constexpr std::uint64_t kAddresses = 1'000'000;  // KB, libraries included
  for (const auto& [words, exit_code] : kReaders) {
    SCOPED_TRACE(words[0] + " " + words[1] + " " + words.back());
    const Ended ended = run_behind_a_long_line(folder, words, kLine, kAddresses);
    EXPECT_EQ(ended.exit_code, exit_code) << slurp(folder.path() / "out");
    EXPECT_LT(ended.peak, exit_code == 3 ? 200 : kMax);
  }
}

TEST(Memory, ALineWithoutEndIsReadInAFewKilobytes) {
  if (!can_measure()) GTEST_SKIP() << "a sanitizer has its own memory";
  const Folder folder;
  const Ended ended = run_behind_a_long_line(folder, {"replay", "-", "--json"}, 100 * kMegabyte);
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_LT(ended.peak, kMax);
  const auto document = nlohmann::json::parse(slurp(folder.path() / "out"));
  EXPECT_EQ(document["log"]["frames"], 20);
  EXPECT_EQ(document["log"]["foreign"], 101);
}

// Minutes, and a file of that size: toolchain/long memory.
TEST(Memory, DISABLED_OfFourGigabytesIsThatOfTwentyMegabytes) {
  if (!can_measure()) GTEST_SKIP() << "a sanitizer has its own memory";
  const Folder folder;
  write_long_log((folder.path() / "long.log").string(), 4'000 * kMegabyte, LongLog(0.02));
  spill(folder.path() / "scene.json", kScene);
  for (const std::vector<std::string>& words : {std::vector<std::string>{"replay", "long.log", "--json"},
                                                {"evaluate", "long.log", "--scene", "scene.json"},
                                                {"report", "long.log", "-o", "report.html"}}) {
    const auto began = std::chrono::steady_clock::now();
    const Ended ended = run(folder, words);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
    std::printf("%s: %.0f MB at its peak, %.0f s\n", words.front().c_str(), ended.peak, took.count());
    EXPECT_EQ(ended.exit_code, 0) << words.front();
    EXPECT_LT(ended.peak, kMax) << words.front();
  }
  EXPECT_LT(std::filesystem::file_size(folder.path() / "report.html"), 2 * kMegabyte);
}

}  // namespace
}  // namespace fencepost::host
