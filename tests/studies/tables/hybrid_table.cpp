// Judges the hybrid on random scenes: against the best of the paper's algorithms in every cell, and against the figures
// it was meant to reach. Prints Markdown; fails if a claim does not hold. The seeds from 5001 on were used for tuning.
#include <fmt/format.h>

#include <functional>
#include <map>

#include "tests/studies/common/study.hpp"
#include "tests/studies/tables/hybrid_judgement.hpp"
#include "tests/studies/tables/hybrid_targets.hpp"
#include "tests/studies/tables/quality_run.hpp"

namespace fencepost::test {
namespace {

struct Request {
  Seeds seeds;
  std::vector<std::string> levels;
  std::vector<std::string> kinds{"sequential", "spread"};
  std::string profile = "full";
};

using Columns = std::vector<std::optional<std::uint32_t>>;

Columns columns() {
  Columns views(kTableViews.begin(), kTableViews.end());
  views.emplace_back();
  return views;
}

std::vector<ScenePair> run_pairs(const Request& request, const NoiseLevel& level, SceneKind kind,
                                 OcclusionFlags flags) {
  QualityOptions options;
  options.kind = kind;
  options.profile = request.profile;
  return request.seeds.each([&](unsigned seed) {
    options.flags = OcclusionFlags::kTrue;
    ScenePair pair{run_scene(seed, level, options), {}};
    options.flags = flags;
    pair.hybrid = flags == OcclusionFlags::kTrue ? pair.paper : run_scene(seed, level, options);
    return pair;
  });
}

std::string cell_text(const CellJudgement& cell, std::string_view mark) {
  return fmt::format(" {:.1f} / {:.1f}; {:+.1f} ± {:.1f} v. {}{} |", cell.recklessness, cell.paranoia, cell.difference,
                     cell.standard_error, cell.rival, mark);
}

/// Everything about one kind of scenes and flags.
struct Section {
  std::string kind;
  std::string flags;
  bool has_targets = false;  ///< the targets are for sequential views
  std::map<std::string, std::vector<CellJudgement>> cells;
  std::map<std::string, std::vector<host::Evaluation>> hybrid;
  std::map<std::string, std::vector<host::Evaluation>> paper;
};

Section run_section(const Request& request, const std::string& kind, const std::string& flags, Tally& tally) {
  Section section{kind, flags, kind == "sequential", {}, {}, {}};
  print(
      fmt::format("**{} views, {} flags** (hybrid: R / P, %; R + P beside the best of the paper's with true flags)\n\n",
                  kind, flags));
  print("| noise | n=2 | 4 | 8 | 18 | end |\n|---|---|---|---|---|---|\n");
  for (const NoiseLevel& level : noise_levels(request.levels)) {
    const auto pairs = run_pairs(request, level, kind == "spread" ? SceneKind::kSpread : SceneKind::kSequential,
                                 flags == "true" ? OcclusionFlags::kTrue : OcclusionFlags::kInferred);
    std::string row = fmt::format("| {} |", level.key);
    std::vector<CellJudgement>& cells = section.cells[std::string(level.key)];
    for (const auto views : columns()) {
      cells.push_back(judge_cell(pairs, views));
      const std::string claim = fmt::format(
          "{} views, {} flags, level {}, n={}: R + P is {:.1f} ± {:.1f} worse than {}", kind, flags, level.key,
          views.value_or(75), cells.back().difference, cells.back().standard_error, cells.back().rival);
      row += cell_text(cells.back(), tally.look(cells.back().holds(), claim));
    }
    print(row + "\n");
    for (const ScenePair& pair : pairs) {
      section.hybrid[std::string(level.key)].push_back(pair.hybrid);
      section.paper[std::string(level.key)].push_back(pair.paper);
    }
  }
  print("\n");
  return section;
}

/// One figure that has to be at most, or at least, another.
std::string figure(Tally& tally, const std::string& what, double value, double limit, bool at_most = true) {
  const bool holds = at_most ? value <= limit : value >= limit;
  const std::string text = fmt::format("{}: {:.3g} (target {} {:.3g})", what, value, at_most ? "<=" : ">=", limit);
  return "- " + text + std::string(tally.look(holds, text)) + "\n";
}

void judge_sums(const Section& section, const HybridTarget& target, Tally& tally) {
  const bool given = section.flags == "true";
  const std::vector<CellJudgement>& cells = section.cells.at(std::string(target.level));
  std::string row = fmt::format("| {} |", target.level);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const double limit = (given ? target.sum_true : target.sum_inferred)[i];
    const std::string claim = fmt::format("{} flags, level {}, n={}: R + P {:.1f} above {:.0f}", section.flags,
                                          target.level, cells[i].views.value_or(75), cells[i].sum(), limit);
    row += fmt::format(" {:.1f} of {:.0f}{} |", cells[i].sum(), limit, tally.look(cells[i].sum() <= limit, claim));
  }
  print(row + "\n");
}

void judge_end(const Section& section, const HybridTarget& target, Tally& tally) {
  const std::string level(target.level);
  const std::string where = fmt::format("{} flags, level {}, end", section.flags, level);
  const CellJudgement& end = section.cells.at(level).back();
  const auto& limit = section.flags == "true" ? target.end_recklessness_true : target.end_recklessness_inferred;
  if (limit) print(figure(tally, where + ", R %", end.recklessness, *limit));
  if (!target.beats_cylinder) return;
  const ModelMeans cylinder = means_of_model(section.paper.at(level), "cylinder_paper", {});
  print(figure(tally, where + ", R % beside Alg. 1", end.recklessness, cylinder.recklessness));
  print(figure(tally, where + ", P % beside Alg. 1", end.paranoia, cylinder.paranoia));
}

void judge_targets(const Section& section, Tally& tally) {
  print(fmt::format("**Targets, {} flags** (R + P, % of at most)\n\n", section.flags));
  print("| noise | n=2 | 4 | 8 | 18 | end |\n|---|---|---|---|---|---|\n");
  const auto each = [&](const std::function<void(const HybridTarget&)>& judge) {
    for (const HybridTarget& target : kHybridTargets) {
      if (section.cells.contains(std::string(target.level))) judge(target);
    }
  };
  each([&](const HybridTarget& target) { judge_sums(section, target, tally); });
  print("\n");
  each([&](const HybridTarget& target) { judge_end(section, target, tally); });
  print("\n");
}

void judge_confidence(const Section& section, Tally& tally) {
  std::vector<host::Evaluation> all;
  for (const auto& [level, scenes] : section.hybrid) all.insert(all.end(), scenes.begin(), scenes.end());
  const std::vector<Confidence> fits = confidences(all);
  print(fmt::format("**Confidence, {} views, {} flags** ({} fits)\n\n", section.kind, section.flags, fits.size()));
  print("| reported | fits | mean | excess R + P | promised |\n|---|---|---|---|---|\n");
  for (const ConfidenceBin& bin : bins_of(fits)) {
    const double off = bin.excess - bin.promised();
    const std::string claim = fmt::format("{} views, {} flags, confidence {:.2g} to {:.2g}: excess off by {:.2f}",
                                          section.kind, section.flags, bin.from, bin.to, off);
    const bool holds = off <= kConfidenceError && off >= -kConfidenceError;
    print(fmt::format("| {:.2g}..{:.2g} | {} | {:.2f} | {:.2f} | {:.2f}{} |\n", bin.from, bin.to, bin.fits,
                      bin.reported, bin.excess, bin.promised(), tally.look(holds, claim)));
  }
  print("\n" +
        figure(tally, fmt::format("{} views, {} flags: Spearman's correlation", section.kind, section.flags),
               spearman(fits), kMinSpearman, false) +
        "\n");
}

void judge_two_convex(const Request& request, Tally& tally) {
  QualityOptions options;
  options.kind = SceneKind::kTwoConvex;
  options.flags = OcclusionFlags::kTrue;
  options.profile = request.profile;
  const auto scenes = request.seeds.each([&](unsigned seed) {
    host::Evaluation scene = run_scene(seed, noise_levels({"2"}).front(), options);
    scene.objects.erase(scene.objects.begin());  // the other one is looked at
    return scene;
  });
  const ModelMeans end = means_of_model(scenes, "hybrid", {});
  print("**Two convex objects, level 2, true flags, end**\n\n");
  print(figure(tally, "two convex objects, R %", end.recklessness, kConvexRecklessness));
  print(figure(tally, "two convex objects, P %", end.paranoia, kConvexParanoia));
  print(figure(tally, "two convex objects, IoU %", end.iou, kConvexOverlap, false));
  print("\n");
}

bool run(const Request& request) {
  Tally tally;
  for (const std::string& kind : request.kinds) {
    for (const char* flags : {"true", "inferred"}) {
      const Section section = run_section(request, kind, flags, tally);
      if (section.has_targets) judge_targets(section, tally);
      judge_confidence(section, tally);
    }
  }
  judge_two_convex(request, tally);
  return tally.report(request.seeds);
}

void options(CLI::App& app, Request& request) {
  add_seed_options(app, request.seeds, "scenes a table, three objects each");
  add_levels_option(app, request.levels);
  app.add_option("--views", request.kinds, "order of the views: sequential, spread")
      ->delimiter(',')
      ->capture_default_str()
      ->check(CLI::IsMember({"sequential", "spread"}));
  add_profile_option(app, request.profile);
}

constexpr Study<Request> kStudy = {"hybrid_table", "The hybrid beside the paper's algorithms and beside its targets",
                                   options, run};

}  // namespace
}  // namespace fencepost::test

int main(int argc, char** argv) { return fencepost::test::kStudy.main(argc, argv); }
