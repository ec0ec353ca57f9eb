#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "host/web/page.hpp"

namespace fencepost::host {
namespace {

constexpr std::string_view kPage = "<body><!-- given --><script>x</script></body>";

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
    const auto html = page_with(kPage, {"run.log", log, std::nullopt});
    ASSERT_TRUE(html);
    EXPECT_EQ(given_in(*html).at("log"), text);
    EXPECT_EQ(given_in(*html).at("name"), "run.log");
    EXPECT_FALSE(given_in(*html).contains("scene"));
  }
}

TEST(PageWith, LeavesTheRestAsItIs) {
  const auto html = page_with(kPage, {"a", "b", std::nullopt});
  ASSERT_TRUE(html);
  EXPECT_EQ(html->rfind("<body><script type", 0), 0U);
  EXPECT_NE(html->find("</script><script>x</script></body>"), std::string::npos);
}

TEST(PageWith, NamesAndScenesCannotEndTheirElement) {
  const std::string hostile = "</script><!--<script>\xff";
  const auto html = page_with(kPage, {hostile, "", "{\"objects\": [{\"name\": \"</script>\"}]}"});
  ASSERT_TRUE(html);
  EXPECT_EQ(given_in(*html).at("scene").at("objects")[0].at("name"), "</script>");
  EXPECT_EQ(given_in(*html).at("name"), "</script><!--<script>\xef\xbf\xbd");
  EXPECT_EQ(html->find("<!--"), std::string::npos);
}

TEST(PageWith, RefusesWhatIsNoPageOrNoScene) {
  EXPECT_FALSE(page_with("<body></body>", {"a", "b", std::nullopt}));
  EXPECT_FALSE(page_with(kPage, {"a", "b", "{"}));
}

}  // namespace
}  // namespace fencepost::host
