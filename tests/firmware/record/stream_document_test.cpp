// The examples in the user's documentation of the stream are lines that are accepted, one of each kind at least.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <regex>
#include <set>

#include "firmware/record/decode.hpp"
#include "tests/firmware/record/lines.hpp"

namespace fencepost::record {
namespace {

TEST(StreamDocument, ItsExamplesAreAcceptedAndCoverEveryKind) {
  std::ifstream file(FENCEPOST_SOURCE_DIR "/host/share/doc/stream.md");
  const std::string document((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  const std::regex example("\\$FP[A-Z]{3},[^*`\n]*\\*[0-9A-F]{4}");
  std::set<Kind> kinds;
  for (std::sregex_iterator at(document.begin(), document.end(), example), end; at != end; ++at) {
    Recorder sink;
    const std::string line = at->str();
    const base::Result<Kind, Reject> kind = decode(line, {}, sink);
    ASSERT_TRUE(kind.ok()) << line << " " << name(kind.error());
    EXPECT_EQ(encoded(sink.records.at(0)), line + "\r\n") << "not as the encoder would write it";
    kinds.insert(*kind);
  }
  EXPECT_EQ(kinds.size(), kKinds);
}

}  // namespace
}  // namespace fencepost::record
