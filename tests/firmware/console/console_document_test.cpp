// The session in host/share/doc/console.md is what a robot says, and the document names every command and setting.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "tests/firmware/loop/desk.hpp"

namespace fencepost::test {
namespace {

std::string document() {
  std::ifstream file(FENCEPOST_SOURCE_DIR "/host/share/doc/console.md", std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  std::string read = text.str();
  std::erase(read, '\\');  // a bar in a table is written \|
  return read;
}

// The lines of the first block that is marked as a session; what was typed stands after "> ".
std::string session() {
  const std::string text = document();
  const std::string fence = "```console\n";
  const std::size_t begin = text.find(fence);
  if (begin == std::string::npos) return "";
  return text.substr(begin + fence.size(), text.find("```", begin + fence.size()) - begin - fence.size());
}

// A robot that drives at a red post for four seconds; then somebody types.
std::string played(const std::string& written) {
  Desk<> desk(console::Mode::kText, desk_approach(200));
  desk.turn(4100);
  std::string said = desk.link.take_said();
  std::istringstream lines(written);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("> ", 0) != 0) continue;
    said += line + "\n" + desk.type_line(line.substr(2));
  }
  std::erase(said, '\r');
  return said;
}

TEST(ConsoleDocument, TheSessionIsWhatARobotSays) {
  const std::string written = session();
  ASSERT_GE(std::count(written.begin(), written.end(), '>'), 10);
  EXPECT_EQ(written, played(written)) << "--- the session as it is now ---\n" << played(written) << "---";
}

TEST(ConsoleDocument, NamesEveryCommandAndSettingWithItsRange) {
  const std::string text = document();
  for (const console::VerbInfo& verb : console::kVerbInfo) {
    std::string usage = "`" + std::string(verb.name);
    if (!verb.arguments.empty()) usage += " " + std::string(verb.arguments);
    EXPECT_NE(text.find(usage + "`"), std::string::npos) << usage;
  }
  for (std::size_t i = 0; i < config::kKeys; ++i) {
    const config::KeyInfo& entry = config::kKeyInfo[i];
    std::array<char, 80> range{};
    console::Sentence sentence(range);
    console::put_range(sentence, config::kKeyInfo[i]);
    const std::size_t size = sentence.end() - 2;
    std::string row = "| `" + std::string(entry.name) + "` | " +
                      std::string(config::Settings{}.text(static_cast<config::Key>(i)).view()) + " | " +
                      std::string(range.data(), size) + " |";
    EXPECT_NE(text.find(row), std::string::npos) << row;
  }
}

}  // namespace
}  // namespace fencepost::test
