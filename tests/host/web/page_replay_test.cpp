#include "host/web/page_replay.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "host/result/to_json.hpp"
#include "tests/host/contents.hpp"

namespace fencepost::host {
namespace {

constexpr double kEnd = 1e9;

// Until all is used, as the page does.
void feed_all(PageReplay& page, std::string_view log) {
  while (!log.empty()) log.remove_prefix(page.feed(log, kEnd));
}

TEST(PageReplay, StopsAtATimeAndGoesOn) {
  const std::string log = test::bundled_log("approach_stop");
  PageReplay page("");
  std::size_t used = page.feed(log, kEnd);  // to the begin of its run
  EXPECT_EQ(page.log().runs(), 1U);
  used += page.feed(std::string_view(log).substr(used), 3.0);
  EXPECT_GE(page.log().time(), 3.0);
  EXPECT_LT(page.log().time(), 3.1);
  EXPECT_EQ(log[used - 1], '\n');
  feed_all(page, std::string_view(log).substr(used));
  page.finish();
  EXPECT_EQ(page.result(), to_json(replay(log, "log", {}).result));
}

TEST(PageReplay, HasTheLatestFrameWithItsObjects) {
  PageReplay page("");
  feed_all(page, test::bundled_log("approach_stop"));
  const auto json = nlohmann::json::parse(page.page());
  const auto& frame = json.at("frame");
  EXPECT_EQ(frame.at("number"), 108);
  EXPECT_NEAR(frame.at("t").get<double>() - frame.at("exposure").get<double>(), 0.05, 1e-9);
  ASSERT_EQ(frame.at("boxes").size(), 1U);
  EXPECT_EQ(frame.at("boxes")[0].at("id"), 1);
  EXPECT_EQ(json.at("settings").at("alert.stop"), "0.25");
  const auto state = nlohmann::json::parse(page.state(true));
  EXPECT_TRUE(state.at("path").empty());
  EXPECT_GT(state.at("alerts").size(), 5U);
  EXPECT_TRUE(nlohmann::json::parse(page.state(false)).at("alerts").empty());
}

TEST(PageReplay, ListsBadLinesUpToAHundred) {
  PageReplay page("small");
  std::string log = "foreign\n$FPODO,1*0000\n";
  for (int i = 0; i < 200; ++i) log += "$FPODO\n";
  feed_all(page, log + "$FP");
  page.finish();
  const auto json = nlohmann::json::parse(page.page());
  ASSERT_EQ(json.at("bad_lines").size(), 100U);
  EXPECT_EQ(json.at("bad_lines")[0].at("line"), 2);
  EXPECT_EQ(json.at("bad_lines")[0].at("reason"), "crc");
  EXPECT_TRUE(json.at("unreadable").get<std::string>().find("no record") != std::string::npos);
}

}  // namespace
}  // namespace fencepost::host
