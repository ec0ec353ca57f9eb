// host/share/doc/two_terminals.md is true: its commands, run as they stand there, show a person what it says.
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <sstream>

#include "tests/host/end_to_end/stage.hpp"
#include "tests/host/end_to_end/terminal.hpp"

namespace fencepost::host::testing {
namespace {

/// A block of the document: a command behind "$ ", and what it shows.
struct Shown {
  std::vector<std::string> words;
  std::vector<std::string> lines;
};

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// The words behind "fencepost"; a backslash at the end of a line goes on with the next one.
Shown block_of(std::vector<std::string> lines) {
  std::string command = lines.front().substr(2);
  lines.erase(lines.begin());
  while (command.ends_with('\\')) {
    command.pop_back();
    command += lines.front();
    lines.erase(lines.begin());
  }
  std::istringstream in(command);
  Shown shown;
  for (std::string word; in >> word;) shown.words.push_back(word);
  shown.words.erase(shown.words.begin());
  shown.lines = std::move(lines);
  return shown;
}

/// The document's blocks of that command, in order.
std::vector<Shown> blocks(const std::string& command) {
  const std::string document = slurp(FENCEPOST_SOURCE_DIR "/host/share/doc/two_terminals.md");
  std::vector<Shown> found;
  std::vector<std::string> block;
  bool inside = false;
  for (const std::string& line : lines_of(document)) {
    if (!line.starts_with("```")) {
      if (inside) block.push_back(line);
      continue;
    }
    if (inside && block.front().starts_with("$ fencepost " + command)) found.push_back(block_of(block));
    inside = !inside;
    block.clear();
  }
  return found;
}

/// Without what depends on time: numbers, bearings, how often a sentence is repeated, reasons of refusals.
std::vector<std::string> plain(const std::vector<std::string>& lines) {
  static const std::pair<std::regex, const char*> kMasks[] = {
      {std::regex("[0-9a-f]{16}"), "DIGEST"},
      {std::regex("[0-9]+(\\.[0-9]+)?"), "#"},
      {std::regex("  (ahead|# deg (left|right))"), ""},
      {std::regex("  in # s"), ""},
      {std::regex("# refused \\([^)]*\\)"), "# refused"},
  };
  std::vector<std::string> masked;
  for (std::string line : lines) {
    for (const auto& [pattern, mask] : kMasks) line = std::regex_replace(line, pattern, mask);
    if (!line.empty() && (masked.empty() || masked.back() != line)) masked.push_back(line);
  }
  return masked;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

std::string sorted(const std::vector<std::string>& lines) {
  std::vector<std::string> copy = plain(lines);
  std::sort(copy.begin(), copy.end());
  return joined(copy);
}

class TwoTerminals : public ::testing::TestWithParam<std::size_t> {};

TEST_P(TwoTerminals, ShowWhatTheDocumentSays) {
  const Shown emulate = blocks("emulate").at(GetParam());
  const Shown run = blocks("run").at(GetParam());
  const Folder folder;
  std::filesystem::create_symlink(FENCEPOST_SOURCE_DIR "/host", folder.path() / "host");
  Terminal first(folder, emulate.words);
  ASSERT_TRUE(first.shows(" on ./wheels\n")) << first.text();
  // A person takes a while to type; what takes longer to start than a second is told.
  std::this_thread::sleep_for(std::chrono::milliseconds(2'500));
  Terminal second(folder, run.words);
  EXPECT_EQ(first.wait(), 0) << first.text();
  ASSERT_TRUE(second.shows("odometry ") && second.shows(" is absent")) << second.text();
  second.type("\x03");
  EXPECT_EQ(second.wait(), 130);
  // Which of the two devices is opened, or heard, first is of no interest.
  EXPECT_EQ(sorted(lines_of(first.text())), sorted(emulate.lines)) << first.text();
  EXPECT_EQ(joined(plain(lines_of(second.text()))), joined(plain(run.lines))) << second.text();
  std::string command = "fencepost";
  for (const std::string& word : blocks("replay").at(0).words) command += " " + word;
  const Outcome check = shell(folder, command);
  EXPECT_EQ(check.exit_code, 0) << check.err;
  EXPECT_EQ(digest_in(check.out), digest_in(second.text()));
}

INSTANTIATE_TEST_SUITE_P(All, TwoTerminals, ::testing::Values(0, 1, 2));

TEST(TwoTerminalsDocument, HasAPairForEachCamera) {
  EXPECT_EQ(blocks("emulate").size(), 3U);
  EXPECT_EQ(blocks("run").size(), 3U);
}

}  // namespace
}  // namespace fencepost::host::testing
