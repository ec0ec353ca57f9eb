#include "tests/studies/reacquisition/study_tables.hpp"

#include <fmt/format.h>

#include "host/paper/algorithm.hpp"

namespace fencepost::test {
namespace {

using host::MatchOutcome;

std::string row(std::string_view landmark, std::string_view type, const StudyScores& scores, auto counts_of) {
  std::string line = fmt::format("| {} | {} |", landmark, type);
  for (const host::ReacquisitionScore& score : scores) {
    const auto [wrong, all] = counts_of(score);
    const double accuracy = all == 0 ? 1 : 1 - static_cast<double>(wrong) / static_cast<double>(all);
    line += fmt::format(" {} of {}, {:.2f} |", wrong, all, 100 * accuracy);
  }
  return line + "\n";
}

std::string value_row(std::string_view what, const StudyScores& scores, auto value_of) {
  std::string line = fmt::format("| {} | |", what);
  for (const host::ReacquisitionScore& score : scores) line += fmt::format(" {:.3f} |", value_of(score));
  return line + "\n";
}

}  // namespace

const std::vector<StudyWorld>& study_worlds() {
  using host::BlocksWorld;
  static const std::vector<StudyWorld> worlds{
      {BlocksWorld::kPaperLike, "paper", "distinct colours (paper-like)", 0.995, 0, true},
      {BlocksWorld::kDistractor, "distractor", "and a same-coloured distractor", 0.980, 0.80, false},
      {BlocksWorld::kHard, "hard", "and landmark-hued background, high noise", 0.968, 0.72, false}};
  return worlds;
}

StudyScores run_world(const StudyWorld& world, unsigned scenes, unsigned first_seed, bool recoloured) {
  StudyScores scores(host::algorithms().size());
  for (unsigned seed = first_seed; seed < first_seed + scenes; ++seed) {
    const host::Tour tour = host::drive(host::blocks_world(world.kind, seed));
    host::RegionRenderer renderer(tour.scene.camera);
    const host::Models models = host::reconstruct(tour, host::block_count(world.kind), {tour.frames.size()});
    for (std::size_t a = 0; a < scores.size(); ++a) {
      std::vector<host::Solid> solids = host::world_of(tour, models, host::algorithms()[a], 0);
      for (host::Solid& solid : solids) {
        if (recoloured) solid.colour = {128, 128, 128};
      }
      scores[a].add(host::reacquire_all(tour, renderer, solids));
    }
  }
  return scores;
}

std::string study_table(const StudyWorld& world, unsigned scenes, const StudyScores& scores) {
  std::string text = fmt::format("\n## {}: {} scenes, wrong decisions of all, % right\n\n| | |", world.name, scenes);
  for (const host::Algorithm& algorithm : host::algorithms()) text += fmt::format(" {} |", algorithm.label);
  text += "\n|---|---|" + [&] {
    std::string dashes;
    for (std::size_t a = 0; a < scores.size(); ++a) dashes += "---|";
    return dashes;
  }() + "\n";
  for (std::size_t landmark = 0; landmark < 2; ++landmark) {
    const char* colour = landmark == host::kRedLandmark ? "Red" : "Yellow";
    for (const MatchOutcome type : {MatchOutcome::kMatched, MatchOutcome::kUnmatched, MatchOutcome::kUnseen}) {
      text += row(colour, host::name(type), scores, [&](const host::ReacquisitionScore& score) {
        return std::pair(score.landmarks[landmark].incorrect(type), score.landmarks[landmark].total(type));
      });
    }
    text += row(colour, "all", scores, [&](const host::ReacquisitionScore& score) {
      return std::pair(score.landmarks[landmark].incorrect(), score.landmarks[landmark].total());
    });
  }
  text += row("Average", "", scores, [](const host::ReacquisitionScore& score) {
    return std::pair(score.all().incorrect(), score.all().total());
  });
  text += value_row("error of right matches", scores, [](const auto& s) { return host::mean(s.right_errors); });
  text += value_row("confidence, right", scores, [](const auto& s) { return host::mean(s.right_confidences); });
  text += value_row("confidence, wrong", scores, [](const auto& s) { return host::mean(s.wrong_confidences); });
  text += value_row("area under curve of confidence", scores,
                    [](const auto& s) { return host::area_under_curve(s.right_confidences, s.wrong_confidences); });
  text += value_row("area under curve of margin", scores,
                    [](const auto& s) { return host::area_under_curve(s.right_margins, s.wrong_margins); });
  return text + value_row("standard error of the average, %", scores,
                          [](const auto& s) { return 100 * host::standard_error(s.scene_accuracies); });
}

std::vector<Verdict> verdicts(const StudyWorld& world, const StudyScores& scores) {
  std::vector<Verdict> all;
  const auto ask = [&](std::string_view who, std::string_view what, double value, double least) {
    const bool reached = value >= least;
    all.push_back(
        {fmt::format("{} {}: {} {:.4f}, asked {:.4f}\n", reached ? "reached" : "MISSED ", who, what, value, least),
         reached});
  };
  for (std::size_t a = 0; a < scores.size(); ++a) {
    const host::Algorithm& algorithm = host::algorithms()[a];
    const double right = scores[a].all().accuracy();
    if (world.against_the_paper && algorithm.paper_average) {
      // The paper's own figure is of 146 decisions; ours is as sure as its scenes allow.
      ask(algorithm.label, "right, and a standard error", right + host::standard_error(scores[a].scene_accuracies),
          *algorithm.paper_average / 100);
    }
    if (algorithm.model != "hybrid") continue;
    ask(algorithm.label, "right", right, world.least_right);
    if (world.least_area > 0) {
      ask(algorithm.label, "area under the curve of the margin",
          host::area_under_curve(scores[a].right_margins, scores[a].wrong_margins), world.least_area);
    }
  }
  return all;
}

}  // namespace fencepost::test
