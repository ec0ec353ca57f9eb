// The memory that long logs take: bytes at the peak, of the program as a process.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
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
constexpr double kSame = 2;   ///< MB
constexpr double kMost = 48;  ///< MB, whatever the log

struct Ended {
  int exit_code = -1;
  double peak = 0;  ///< MB
};

/// `fencepost words...` in `folder`, with its output in the file `out` there.
Ended run(const Folder& folder, std::vector<std::string> words, int in = -1) {
  words.insert(words.begin(), "fencepost");
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t first;
  ::posix_spawn_file_actions_init(&first);
  ::posix_spawn_file_actions_addchdir_np(&first, folder.path().c_str());
  ::posix_spawn_file_actions_addopen(&first, STDOUT_FILENO, "out", O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (in >= 0) ::posix_spawn_file_actions_adddup2(&first, in, STDIN_FILENO);
  pid_t pid = -1;
  EXPECT_EQ(::posix_spawn(&pid, FENCEPOST_EXE, &first, nullptr, arguments.data(), environ), 0);
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
                                                  {"evaluate", "--scene", "scene.json"}}) {
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
    EXPECT_LT(peaks[1], kMost);
    if (command[1] == "--json") {
      const auto document = nlohmann::json::parse(slurp(folder.path() / "out"));
      EXPECT_GT(document["alerts"].size(), 5'000U) << "the log has to be of the kind that fills memory";
      EXPECT_GT(document["path"].size(), 1'000U);
      EXPECT_LE(document["path"].size(), 2'000U);
      EXPECT_EQ(document["log"]["rejected"]["crc"], 0);
    }
  }
}

TEST(Memory, ALineWithoutEndIsReadInAFewKilobytes) {
  if (!can_measure()) GTEST_SKIP() << "a sanitizer has its own memory";
  const Folder folder;
  std::array<int, 2> pipe{};
  ASSERT_EQ(::pipe2(pipe.data(), O_CLOEXEC), 0);
  std::thread writer([to = pipe[1]] {
    const auto write_all = [to](std::string_view text) {
      while (!text.empty()) {
        const ssize_t written = ::write(to, text.data(), text.size());
        if (written <= 0) return;
        text.remove_prefix(static_cast<std::size_t>(written));
      }
    };
    const std::string part(1U << 16U, 'x');
    for (std::uint64_t size = 0; size < 100 * kMegabyte; size += part.size()) write_all(part);
    write_all("\n" + LongLog::begin());
    LongLog log;
    for (int i = 0; i < 100; ++i) write_all(log.next());
    ::close(to);
  });
  const Ended ended = run(folder, {"replay", "-", "--json"}, pipe[0]);
  ::close(pipe[0]);
  writer.join();
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_LT(ended.peak, kMost);
  const auto document = nlohmann::json::parse(slurp(folder.path() / "out"));
  EXPECT_EQ(document["log"]["frames"], 20);
  EXPECT_EQ(document["log"]["foreign"], 101);
}

}  // namespace
}  // namespace fencepost::host
