// Measures that were written in parts and joined again.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "host/evaluate/evaluate.hpp"
#include "host/evaluate/evaluation_json.hpp"
#include "host/evaluate/evaluation_part.hpp"
#include "host/evaluate/evaluation_text.hpp"

namespace fencepost::host {
namespace {

/// An evaluation whose numbers have more digits than are shown.
Evaluation measured(const std::string& log, double third) {
  Evaluation evaluation;
  evaluation.log = log;
  evaluation.scene = log + ".json";
  evaluation.frame_truth = true;
  evaluation.frames = 75;
  evaluation.digest = 0xfedcba9876543210;
  evaluation.profile = "full";
  evaluation.models = {"cylinder", "clip"};
  evaluation.swaps = 2;
  ObjectEvaluation found{0, "red box", 1, 70, false, FoundObject{4, record::ObjectState::kLost, 69}, 1, {}};
  found.cuts.push_back({2, false, third / 7, {{"clip", {third, third / 3, 1 - third}}}, 0});
  found.cuts.push_back({69, true, std::nullopt, {{"cylinder", {0, 1, third}}, {"clip", {third, 0.1, 0.2}}}, 0});
  ObjectEvaluation missed{1, "blue", 2, 33, true, std::nullopt, std::nullopt, {}};
  missed.cuts.push_back({33, true, std::nullopt, {}, 0});
  evaluation.objects = {found, missed};
  evaluation.phantoms = {{9, 1, 12, 0}, {10, 3, 5, std::nullopt}};
  return evaluation;
}

std::string text_of(const EvaluationPart& part) {
  const Summary summary = summarise(part.evaluations, part.views);
  return to_json(part.evaluations, summary, part.views, part.unjudged) +
         evaluation_text(part.evaluations, summary, part.views, part.unjudged);
}

TEST(Parts, JoinedAreTheWholeToTheLastByte) {
  const EvaluationPart a{{2, 8}, {measured("a", 1.0 / 3), measured("b", 0.1 + 0.2)}, {}};
  const EvaluationPart b{{2, 8}, {measured("c", 2.0 / 3)}, {{"bad.log", "bad.log: empty; try again"}}};
  EvaluationPart whole = a;
  whole.evaluations.push_back(b.evaluations[0]);
  whole.unjudged = b.unjudged;
  const EvaluationPart joined = join_parts({read_part(part_json(a), "a"), read_part(part_json(b), "b")});
  EXPECT_EQ(text_of(joined), text_of(whole));
  EXPECT_EQ(part_json(joined), part_json(whole)) << "joined ones can be joined again";
  EXPECT_NE(text_of(whole).find("not judged: bad.log"), std::string::npos);
  const EvaluationPart one{{2, 8}, {measured("a", 1.0 / 3)}, {}};
  EXPECT_EQ(text_of(join_parts({read_part(part_json(one), "a")})), text_of(one));
}

TEST(Parts, OfOtherViewsAreNotJoined) { EXPECT_THROW(join_parts({{{2, 8}, {}, {}}, {{2, 4}, {}, {}}}), NotAPart); }

TEST(Parts, WhatIsNoneIsRefusedByName) {
  const EvaluationPart part{{2}, {measured("a", 0.5)}, {}};
  const std::string good = part_json(part);
  auto phantom = nlohmann::ordered_json::parse(good);
  phantom["logs"][0]["phantoms"][0]["follows"] = 2;
  auto state = nlohmann::ordered_json::parse(good);
  state["logs"][0]["objects"][0]["found"]["state"] = "gone";
  auto digest = nlohmann::ordered_json::parse(good);
  digest["logs"][0]["digest"] = "no digits";
  const Summary summary = summarise(part.evaluations, part.views);
  for (const std::string& text : std::vector<std::string>{
           "", "{", "[]", "{}", "3", "{\"part\": true}", good.substr(0, good.size() / 2), phantom.dump(), state.dump(),
           digest.dump(), to_json(part.evaluations, summary, part.views)}) {
    try {
      read_part(text, "some.part");
      ADD_FAILURE() << text;
    } catch (const NotAPart& problem) {
      EXPECT_FALSE(std::string(problem.what()).empty());
    }
  }
  EXPECT_THROW(
      {
        try {
          read_part(to_json(part.evaluations, summary, part.views), "some.json");
        } catch (const NotAPart& problem) {
          EXPECT_NE(std::string(problem.what()).find("some.json: no part"), std::string::npos);
          throw;
        }
      },
      NotAPart);
}

}  // namespace
}  // namespace fencepost::host
