#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "host/web/page.hpp"
#include "host/web/with_calibration.hpp"

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

TEST(PageWith, HasWhatWasThinnedUnderAnotherName) {
  const GivenLog log{"long.log", "abc", std::nullopt, true};
  const auto html = page_with(kPage, {log});
  ASSERT_TRUE(html);
  EXPECT_EQ(given_in(*html)["logs"][0].at("thinned"), "YWJj");
  EXPECT_FALSE(given_in(*html)["logs"][0].contains("log"));
}

TEST(PageWith, AddsNoMoreThanItSays) {
  const GivenLog logs[] = {{"a", "", std::nullopt},
                           {std::string(50, '<'), "", std::nullopt},
                           {std::string(50, '\x01'), "", "{  \"objects\" : [ \"<<<<\" ] }"},
                           {std::string(50, '\xff'), "", std::nullopt}};
  const std::size_t empty = page_with(kPage, {})->size();
  for (const GivenLog& log : logs) EXPECT_LE(page_with(kPage, {log})->size(), empty + bytes_around(log)) << log.name;
}

std::string with_calibration(std::string_view log, std::size_t portion) {
  WithCalibration filter(
      [&] {
        const std::string_view part = log.substr(0, portion);
        log.remove_prefix(part.size());
        return part;
      },
      "$FPCAM\n");
  std::string text;
  for (std::string_view part = filter.next(); !part.empty(); part = filter.next()) text += part;
  EXPECT_TRUE(filter.next().empty());
  return text;
}

TEST(WithCalibration, StandsInEveryRun) {
  for (const std::size_t portion : {1U, 3U, 8U, 1000U}) {
    const auto made = [portion](std::string_view log) { return with_calibration(log, portion); };
    EXPECT_EQ(made("$FPODO,1\n"), "$FPCAM\n$FPODO,1\n");
    EXPECT_EQ(made(""), "$FPCAM\n");
    EXPECT_EQ(made("boot\n$FPHDR,1\n$FPODO,1\n$FPHDR,1\nx"), "boot\n$FPHDR,1\n$FPCAM\n$FPODO,1\n$FPHDR,1\n$FPCAM\nx");
    EXPECT_EQ(made("$FPHDR,1"), "$FPHDR,1$FPCAM\n") << "an unfinished line";
    EXPECT_EQ(made("\n\r\nboot\n$FPODO,1\n$FPHDR,1\n"), "\n\r\nboot\n$FPCAM\n$FPODO,1\n$FPHDR,1\n$FPCAM\n");
    EXPECT_EQ(made("$FP"), "$FPCAM\n$FP");
  }
}

}  // namespace
}  // namespace fencepost::host
