#include "host/cli/log_input.hpp"

#include <gtest/gtest.h>

#include <string>

#include "host/cli/exit_code.hpp"
#include "host/text/gunzip.hpp"
#include "tests/host/cli/run.hpp"

namespace fencepost::host::cli {
namespace {

using namespace testing;

std::string read_all(LogInput& input) {
  std::string text;
  for (std::string_view part = input.next(); !part.empty(); part = input.next()) text += part;
  return text;
}

/// A text of some size, with lines that differ.
std::string numbers() {
  std::string text;
  for (int i = 0; i < 200'000; ++i) text += std::to_string(i * 7919) + "\n";
  return text;
}

TEST(LogInput, GivesAFileInPortions) {
  const std::string text = numbers();
  spill("log", text);
  LogInput input((folder() / "log").string());
  EXPECT_EQ(input.size(), text.size());
  EXPECT_LE(input.next().size(), 1U << 16U);
  EXPECT_GT(input.position(), 0U);
  LogInput again((folder() / "log").string());
  EXPECT_EQ(read_all(again), text);
  EXPECT_EQ(again.position(), text.size());
  EXPECT_TRUE(again.next().empty());
}

TEST(LogInput, UnpacksWhatGzipPackedInMembers) {
  const std::string text = numbers();
  spill("log", text);
  ASSERT_EQ(shell("gzip -c log >a.gz; gzip -c log >>a.gz; head -c 100000 a.gz >cut.gz; printf x >>a.gz").exit_code, 0);
  const std::string packed = slurp("a.gz");
  spill("whole.gz", packed.substr(0, packed.size() - 1));
  LogInput whole((folder() / "whole.gz").string());
  EXPECT_EQ(read_all(whole), text + text);
  EXPECT_EQ(gunzip(packed.substr(0, packed.size() - 1)), text + text);
  for (const char* damaged : {"a.gz", "cut.gz"}) {
    LogInput input((folder() / damaged).string());
    EXPECT_THROW(read_all(input), Failure) << damaged;
    EXPECT_FALSE(gunzip(slurp(folder() / damaged))) << damaged;
  }
  EXPECT_FALSE(gunzip(""));
}

TEST(LogInput, AByteAtATimeIsTheSame) {
  Gunzip unpacker;
  ASSERT_EQ(shell("printf 'one line\\n' | gzip >log.gz").exit_code, 0);
  std::string text;
  for (const char byte : slurp("log.gz")) {
    const std::string one(1, byte);
    unpacker.feed(one);
    for (std::string_view part = unpacker.next(); !part.empty(); part = unpacker.next()) text += part;
  }
  EXPECT_TRUE(unpacker.complete());
  EXPECT_EQ(text, "one line\n");
}

TEST(LogInput, FromAPipeThatGivesOneByteFirst) {
  const std::string log = "'" FENCEPOST_SOURCE_DIR "/host/share/recordings/selftest.log'";
  const std::string plain = shell("fencepost replay " + log).out;
  EXPECT_FALSE(plain.empty());
  const std::string dribble = "{ head -c 1 p; sleep 0.1; tail -c +2 p; } | fencepost replay -";
  EXPECT_EQ(shell("gzip -c " + log + " >p; " + dribble).out, plain);
  EXPECT_EQ(shell("cp " + log + " p; " + dribble).out, plain);
}

}  // namespace
}  // namespace fencepost::host::cli
