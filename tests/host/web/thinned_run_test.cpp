#include "host/web/thinned_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "host/text/gunzip.hpp"
#include "tests/host/contents.hpp"

namespace fencepost::host {
namespace {

using nlohmann::json;

class AllAlerts final : public AlertSink {
 public:
  void run_begins() override { all.clear(); }
  void hear(const record::AlertReport& alert) override { all.push_back(alert); }
  std::vector<record::AlertReport> all;
};

struct Thinned {
  explicit Thinned(std::string_view log) : run({}, alerts) {
    for (; !log.empty(); log.remove_prefix(std::min<std::size_t>(1000, log.size()))) run.take(log.substr(0, 1000));
    run.finish();
  }
  [[nodiscard]] ThinnedText text(std::size_t most) const {
    return run.text(
        [this](const auto& visit) {
          for (const record::AlertReport& alert : alerts.all) visit(alert);
        },
        most);
  }
  AllAlerts alerts;
  ThinnedRun run;
};

json kept_in(const ThinnedText& text) { return json::parse(gunzip(text.packed).value_or("")); }

TEST(ThinnedRun, EndsAsTheLogDoes) {
  const std::string log = test::bundled_log("wro_lap");
  const Thinned thinned(log);
  const json kept = kept_in(thinned.text(10'000'000));
  const json whole = json::parse(to_json(replay(log, "log", {}).result));
  for (const char* key : {"digest", "alerts", "objects", "log", "guard"})
    EXPECT_EQ(kept["result"][key], whole[key]) << key;
  EXPECT_EQ(kept["alerts"], whole["alerts"].size());
  EXPECT_EQ(kept["page"]["unreadable"], nullptr);
}

TEST(ThinnedRun, LooksAreWhatALogThatEndsThereHas) {
  const std::string log = test::bundled_log("wro_lap");
  const json kept = kept_in(Thinned(log).text(10'000'000));
  const json& looks = kept["looks"];
  ASSERT_GT(looks.size(), 30U);
  double before = -1;
  for (const json& look : looks) {
    EXPECT_GT(look["time"].get<double>(), before);
    before = look["time"];
  }
  const json& look = looks[looks.size() / 2];
  ReplayOptions until;
  until.to = look["time"].get<double>() + 1e-5;
  // If several inputs have one time, the look may have had the first alone.
  const json then = json::parse(to_json(replay(log, "log", until).result));
  ASSERT_EQ(look["result"]["objects"].size(), then["objects"].size());
  for (std::size_t i = 0; i < then["objects"].size(); ++i) {
    EXPECT_EQ(look["result"]["objects"][i]["id"], then["objects"][i]["id"]);
  }
  EXPECT_FALSE(look["frame"].is_null());
  EXPECT_TRUE(look["result"]["objects"][0]["models"].contains("hybrid"));
  EXPECT_FALSE(look["result"]["objects"][0]["models"].contains("carve"));
}

// A stop is looked at when it begins.
TEST(ThinnedRun, LooksWhereItStops) {
  const Thinned thinned(test::bundled_log("approach_stop"));
  const json kept = kept_in(thinned.text(10'000'000));
  std::size_t stops = 0;
  for (const record::AlertReport& alert : thinned.alerts.all) {
    if (alert.level != record::AlertLevel::kStop) continue;
    ++stops;
    EXPECT_TRUE(std::ranges::any_of(kept["looks"], [&](const json& look) {
      return std::abs(look["time"].get<double>() - alert.t.to_double()) < 0.1;
    }));
  }
  EXPECT_GT(stops, 0U);
  EXPECT_EQ(kept["stops"], stops);
}

TEST(ThinnedRun, IsAsSmallAsAskedAndSaysWhatItHas) {
  const Thinned thinned(test::bundled_log("wro_lap"));
  std::size_t before = 0;
  for (const std::size_t most : {12'000U, 40'000U, 100'000U}) {
    const ThinnedText text = thinned.text(most);
    EXPECT_LE(text.packed.size(), most);
    const json kept = kept_in(text);
    EXPECT_GE(kept["looks"].size(), before);
    before = kept["looks"].size();
    EXPECT_EQ(kept["said"], text.said);
    EXPECT_NE(text.said.find("map and camera at " + std::to_string(before) + " times"), std::string::npos) << text.said;
    EXPECT_EQ(kept["path"].size() % 4, 0U);
    EXPECT_NE(text.said.find(std::to_string(kept["path"].size() / 4) + " of "), std::string::npos) << text.said;
  }
}

TEST(ThinnedRun, OfSeveralRunsShowsTheLast) {
  const std::string log = test::bundled_log("approach_stop");
  const Thinned twice(test::bundled_log("corridor") + log);
  const Thinned once(log);
  EXPECT_EQ(kept_in(twice.text(10'000'000))["looks"].size(), kept_in(once.text(10'000'000))["looks"].size());
  EXPECT_EQ(kept_in(twice.text(10'000'000))["alerts"], kept_in(once.text(10'000'000))["alerts"]);
}

TEST(ThinnedRun, ALogOfNothingHasItsReason) {
  const json kept = kept_in(Thinned("hello\n").text(10'000));
  EXPECT_NE(kept["page"]["unreadable"].get<std::string>().find("no record"), std::string::npos);
  EXPECT_TRUE(kept["looks"].empty());
  EXPECT_TRUE(kept["path"].empty());
}

}  // namespace
}  // namespace fencepost::host
