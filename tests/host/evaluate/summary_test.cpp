// Means, counts, text and JSON of hand-made evaluations.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "host/evaluate/evaluate.hpp"
#include "host/evaluate/evaluation_json.hpp"
#include "host/evaluate/evaluation_text.hpp"

namespace fencepost::host {
namespace {

using nlohmann::json;

const std::vector<std::uint32_t> kViews{2, 8};

ObjectEvaluation found(std::uint32_t id, double recklessness) {
  ObjectEvaluation object;
  object.name = "box " + std::to_string(id);
  object.signature = 1;
  object.visible = 30;
  object.found = {id, record::ObjectState::kConfirmed, 8};
  object.swaps = 0;
  object.cuts = {{2, false, std::nullopt, {{"clip", kEmptyScore}}},
                 {8, false, 0.02, {{"clip", {recklessness, 0.5, 0.25}}}},
                 {8, true, 0.01, {{"clip", {recklessness / 2, 0.5, 0.25}}}}};
  return object;
}

ObjectEvaluation missed() {
  ObjectEvaluation object;
  object.name = "can";
  object.visible = 20;
  object.missed = true;
  object.cuts = {{2, false, std::nullopt, {}}, {8, false, std::nullopt, {}}, {20, true, std::nullopt, {}}};
  return object;
}

Evaluation log_of(std::vector<ObjectEvaluation> objects) {
  Evaluation evaluation;
  evaluation.log = "a.log";
  evaluation.scene = "a.json";
  evaluation.frame_truth = true;
  evaluation.profile = "full";
  evaluation.models = {"clip"};
  evaluation.objects = std::move(objects);
  evaluation.swaps = 0;
  return evaluation;
}

// The row of that many views, alive as long as `summary`.
const SummaryRow& row_at(const Summary& summary, std::optional<std::uint32_t> views) {
  for (const SummaryRow& row : summary.rows) {
    if (row.views == views) return row;
  }
  throw std::out_of_range("no such row");
}
const SummaryRow& row_at(Summary&&, std::optional<std::uint32_t>) = delete;

// 0.2 and 0.4: mean 0.3, deviations 0.1 and 0.1, variance (0.01 + 0.01) / 1, of the mean 0.02 / 2 = 0.1^2.
TEST(Summary, GivesMeansWithStandardErrors) {
  const std::vector<Evaluation> logs{log_of({found(1, 0.2)}), log_of({found(2, 0.4)})};
  const Summary summary = summarise(logs, kViews);
  const SummaryRow& row = row_at(summary, 8);
  EXPECT_NEAR(row.recklessness.mean, 0.3, 1e-12);
  EXPECT_NEAR(row.recklessness.standard_error.value(), 0.1, 1e-12);
  EXPECT_EQ(row.recklessness.n, 2U);
  EXPECT_NEAR(row.paranoia.standard_error.value(), 0, 1e-12);
  EXPECT_NEAR(row_at(summary, std::nullopt).recklessness.mean, 0.15, 1e-12);
}

TEST(Summary, OneObjectHasNoStandardError) {
  const std::vector<Evaluation> logs{log_of({found(1, 0.2)})};
  const Summary summary = summarise(logs, kViews);
  EXPECT_EQ(row_at(summary, 8).recklessness.standard_error, std::nullopt);
}

// R: (0.2 + 1) / 2, P: 0.5 of the one that has area, IoU: (0.25 + 0) / 2; there is no place whose error could count.
TEST(Summary, AMissedObjectCountsAsAnEmptyModel) {
  const std::vector<Evaluation> logs{log_of({found(1, 0.2), missed()})};
  const Summary summary = summarise(logs, kViews);
  const SummaryRow& row = row_at(summary, 8);
  EXPECT_NEAR(row.recklessness.mean, 0.6, 1e-12);
  EXPECT_NEAR(row.paranoia.mean, 0.5, 1e-12);
  EXPECT_EQ(row.paranoia.n, 1U);
  EXPECT_EQ(row.empty, 1U);
  EXPECT_EQ(row_at(summary, 2).empty, 2U) << "the one that was found has no area yet";
  EXPECT_EQ(row_at(summary, 2).recklessness.mean, 1);
  EXPECT_EQ(row_at(summary, 2).paranoia.n, 0U);
  EXPECT_NEAR(row.iou.mean, 0.125, 1e-12);
  EXPECT_EQ(row.iou.n, 2U);
  ASSERT_EQ(summary.position.size(), 3U);
  EXPECT_EQ(summary.position[0].error.n, 0U);
  EXPECT_EQ(summary.position[1].error.n, 1U);
  EXPECT_EQ(summary.objects, 2U);
  EXPECT_EQ(summary.found, 1U);
  EXPECT_EQ(summary.missed, 1U);
}

TEST(Summary, AModelThatOneProfileLacksIsAveragedOverTheOthers) {
  std::vector<Evaluation> logs{log_of({found(1, 0.2)}), log_of({found(2, 0.4)})};
  logs[1].models.emplace_back("sheaf");
  logs[1].objects[0].cuts[1].models.push_back({"sheaf", {0.5, 0.5, 0.5}});
  const Summary summary = summarise(logs, kViews);
  ASSERT_EQ(summary.rows.size(), 6U);
  EXPECT_EQ(summary.rows[3].model, "sheaf");
  EXPECT_EQ(summary.rows[4].recklessness.n, 1U);
}

TEST(Summary, SwapsAreKnownOnlyIfEveryLogsAre) {
  std::vector<Evaluation> logs{log_of({found(1, 0.2)}), log_of({found(2, 0.4)})};
  logs[0].swaps = 3;
  EXPECT_EQ(summarise(logs, kViews).swaps, 3U);
  logs[1].swaps.reset();
  EXPECT_EQ(summarise(logs, kViews).swaps, std::nullopt);
}

TEST(Summary, AnObjectThatWasHardlySeenCountsNowhere) {
  ObjectEvaluation unseen;
  unseen.visible = 3;
  const Summary summary = summarise(std::vector<Evaluation>{log_of({unseen})}, kViews);
  EXPECT_EQ(summary.objects, 0U);
  EXPECT_EQ(summary.missed, 0U);
  EXPECT_EQ(summary.rows.back().recklessness.n, 0U);
}

TEST(Json, HasTheDocumentedKeys) {
  Evaluation log = log_of({found(1, 0.2), missed()});
  log.phantoms = {{7, 2, 9, 0}, {8, 2, 9, std::nullopt}};
  const std::vector<Evaluation> logs{log};
  const json document = json::parse(to_json(logs, summarise(logs, kViews), kViews));
  EXPECT_EQ(document["format"], 2);
  EXPECT_EQ(document["views"], json({2, 8}));
  const json& summary = document["summary"];
  for (const char* key : {"logs", "objects", "found", "missed", "phantoms", "swaps", "models", "position"}) {
    EXPECT_TRUE(summary.contains(key)) << key;
  }
  EXPECT_EQ(summary["models"][1]["views"], 8);
  EXPECT_EQ(summary["models"][2]["views"], nullptr);
  EXPECT_EQ(summary["models"][1]["recklessness"]["mean"], 0.6);
  EXPECT_EQ(summary["models"][1]["recklessness"]["n"], 2);
  EXPECT_EQ(summary["models"][1]["empty"], 1);
  EXPECT_EQ(summary["models"][0]["paranoia"]["mean"], nullptr);
  EXPECT_EQ(summary["position"][0]["error"]["mean"], nullptr);
  const json& object = document["logs"][0]["objects"][0];
  EXPECT_EQ(object["found"], json({{"id", 1}, {"state", "confirmed"}, {"views", 8}, {"swaps", 0}}));
  EXPECT_EQ(object["cuts"][1]["models"]["clip"], json({{"recklessness", 0.2}, {"paranoia", 0.5}, {"iou", 0.25}}));
  EXPECT_EQ(object["cuts"][0]["models"]["clip"], json({{"recklessness", 1}, {"paranoia", nullptr}, {"iou", 0}}));
  EXPECT_EQ(object["cuts"][2]["end"], true);
  EXPECT_EQ(object["cuts"][0]["position_error"], nullptr);
  EXPECT_EQ(document["logs"][0]["objects"][1]["found"], nullptr);
  EXPECT_EQ(document["logs"][0]["phantoms"][0]["follows"], 0);
  EXPECT_EQ(document["logs"][0]["phantoms"][1]["follows"], nullptr);
}

TEST(Text, NamesWhatWasMissedAndWhatIsNotThere) {
  Evaluation log = log_of({found(1, 0.2), missed()});
  log.phantoms = {{7, 2, 9, 0}};
  log.objects[1].name = "ca\nn";
  std::vector<Evaluation> logs{log};
  const std::string one = evaluation_text(logs, summarise(logs, kViews), kViews);
  EXPECT_NE(one.find("ca?n: missed, visible in 20 frames\n"), std::string::npos) << one;
  EXPECT_NE(one.find("phantom: object 7, signature 2, 9 views, a double of box 1\n"), std::string::npos) << one;
  EXPECT_NE(one.find("  20/50/25"), std::string::npos) << one;
  EXPECT_NE(one.find("2 true objects: 1 found, 1 missed; 1 phantom; 0 identity swaps\n"), std::string::npos) << one;
  logs.push_back(log_of({found(1, 0.4)}));
  const std::string several = evaluation_text(logs, summarise(logs, kViews), kViews);
  EXPECT_NE(several.find("a.log: missed ca?n\n"), std::string::npos) << several;
  EXPECT_NE(several.find("+-"), std::string::npos) << several;
  EXPECT_NE(one.find("clip                empty  20/50/25"), std::string::npos) << one;
  EXPECT_NE(several.find("clip                8   53.3 +- 24.0   50.0 +-  0.0   16.7 +-  8.3       3     1\n"),
            std::string::npos)
      << several;
}

}  // namespace
}  // namespace fencepost::host
