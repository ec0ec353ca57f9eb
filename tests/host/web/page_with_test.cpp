#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "host/web/page.hpp"

namespace fencepost::host {
namespace {

constexpr std::string_view kPage =
    "<meta content=\"default-src 'none'; connect-src 'none'\"><body><!-- given --><script>x</script></body>";

nlohmann::json given_in(const std::string& html) {
  const std::string open = "<script type=\"application/json\" id=\"given\">";
  const std::size_t begin = html.find(open) + open.size();
  return nlohmann::json::parse(html.substr(begin, html.find("</script>", begin) - begin));
}

TEST(PageWith, HasTheLogInIt) {
  // By hand: "a" is YQ==, "ab" YWI=, "abc" YWJj; ff fe is //4=.
  const std::pair<std::string, std::string> known[] = {{"", ""},        {"a", "YQ=="},        {"ab", "YWI="},
                                                       {"abc", "YWJj"}, {"abca", "YWJjYQ=="}, {"\xff\xfe", "//4="}};
  for (const auto& [log, text] : known) {
    const auto html = page_with(kPage, {{"run.log", log, std::nullopt}});
    ASSERT_TRUE(html);
    const auto given = given_in(*html);
    ASSERT_EQ(given.at("logs").size(), 1U);
    EXPECT_EQ(given["logs"][0].at("log"), text);
    EXPECT_EQ(given["logs"][0].at("name"), "run.log");
    EXPECT_FALSE(given["logs"][0].contains("scene"));
    EXPECT_FALSE(given.contains("profile"));
  }
}

TEST(PageWith, LeavesTheRestAsItIs) {
  const auto html = page_with(kPage, {{"a", "b", std::nullopt}});
  ASSERT_TRUE(html);
  EXPECT_EQ(html->substr(0, html->find("<script type")), kPage.substr(0, kPage.find("<!--")));
  EXPECT_NE(html->find("</script><script>x</script></body>"), std::string::npos);
}

TEST(PageWith, NamesAndScenesCannotEndTheirElement) {
  const std::string hostile = "</script><!--<script>\xff";
  const auto html = page_with(kPage, {{hostile, "", "{\"objects\": [{\"name\": \"</script>\"}]}"}});
  ASSERT_TRUE(html);
  const auto given = given_in(*html).at("logs").at(0);
  EXPECT_EQ(given.at("scene").at("objects")[0].at("name"), "</script>");
  EXPECT_EQ(given.at("name"), "</script><!--<script>\xef\xbf\xbd");
  EXPECT_EQ(html->find("<!--"), std::string::npos);
}

TEST(PageWith, RefusesWhatIsNoPageOrNoScene) {
  EXPECT_FALSE(page_with("<body></body>", {{"a", "b", std::nullopt}}));
  EXPECT_FALSE(page_with(kPage, {{"a", "b", "{"}}));
  EXPECT_FALSE(page_of_stream("<body><!-- given --></body>", "run", "/log"));
  EXPECT_FALSE(page_of_stream("<meta content=\"connect-src 'none'\">", "run", "/log"));
}

TEST(PageWith, TakesSeveralLogsAndAProfile) {
  const auto html = page_with(kPage, {{"a", "1", std::nullopt}, {"b", "2", "{}"}}, "small");
  ASSERT_TRUE(html);
  EXPECT_EQ(given_in(*html).at("logs").size(), 2U);
  EXPECT_EQ(given_in(*html)["logs"][1].at("name"), "b");
  EXPECT_EQ(given_in(*html).at("profile"), "small");
}

TEST(PageOfStream, MayAskItsOwnServerAndNobodyElse) {
  const auto html = page_of_stream(kPage, "run", "/log");
  ASSERT_TRUE(html);
  EXPECT_EQ(html->rfind("<meta content=\"default-src 'none'; connect-src 'self'\">", 0), 0U);
  EXPECT_EQ(given_in(*html).at("stream").at("path"), "/log");
  EXPECT_EQ(given_in(*html).at("stream").at("name"), "run");
}

TEST(WithCalibration, StandsInEveryRun) {
  EXPECT_EQ(with_calibration("$FPODO,1\n", "$FPCAM\n"), "$FPCAM\n$FPODO,1\n");
  EXPECT_EQ(with_calibration("", "$FPCAM\n"), "$FPCAM\n");
  EXPECT_EQ(with_calibration("boot\n$FPHDR,1\n$FPODO,1\n$FPHDR,1\nx", "$FPCAM\n"),
            "boot\n$FPHDR,1\n$FPCAM\n$FPODO,1\n$FPHDR,1\n$FPCAM\nx");
  EXPECT_EQ(with_calibration("$FPHDR,1", "$FPCAM\n"), "$FPHDR,1$FPCAM\n") << "an unfinished line";
}

}  // namespace
}  // namespace fencepost::host
