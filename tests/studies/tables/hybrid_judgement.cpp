#include "tests/studies/tables/hybrid_judgement.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>

#include "tests/studies/tables/quality_run.hpp"

namespace fencepost::test {
namespace {

constexpr const char* kHybrid = "hybrid";

const host::Cut* cut_at(const host::Evaluation& evaluation, std::size_t truth, std::optional<std::uint32_t> views) {
  for (const host::ObjectEvaluation& object : evaluation.objects) {
    if (object.truth != truth) continue;
    for (const host::Cut& cut : object.cuts) {
      if (views ? !cut.end && cut.views == *views : cut.end) return &cut;
    }
  }
  return nullptr;
}

/// A model that is not there has no area.
host::Score score_of(const host::Cut& cut, const std::string& model) {
  for (const host::ModelScore& entry : cut.models) {
    if (entry.model == model) return entry.score;
  }
  return {};
}

double sum_of(const host::Score& score) { return 100 * (score.recklessness + score.paranoia); }

/// One object in both runs.
struct Pair {
  std::size_t scene = 0;
  host::Score hybrid;
  std::vector<double> rivals;  ///< R + P, by paper_models()
};

std::vector<Pair> pairs_at(std::span<const ScenePair> scenes, std::optional<std::uint32_t> views) {
  std::vector<Pair> pairs;
  for (std::size_t scene = 0; scene < scenes.size(); ++scene) {
    for (const host::ObjectEvaluation& object : scenes[scene].paper.objects) {
      const host::Cut* paper = cut_at(scenes[scene].paper, object.truth, views);
      const host::Cut* hybrid = cut_at(scenes[scene].hybrid, object.truth, views);
      if (paper == nullptr || hybrid == nullptr) continue;
      Pair pair{scene, score_of(*hybrid, kHybrid), {}};
      for (const std::string& model : paper_models()) pair.rivals.push_back(sum_of(score_of(*paper, model)));
      pairs.push_back(std::move(pair));
    }
  }
  return pairs;
}

/// The standard error of the mean over all objects, with scenes as units. Scenes may differ in their number of objects.
double error_by_scenes(const std::map<std::size_t, std::vector<double>>& scenes, double mean, std::size_t objects) {
  double squares = 0;
  for (const auto& [scene, values] : scenes) {
    double off = 0;
    for (const double value : values) off += value - mean;
    squares += off * off;
  }
  const auto count = static_cast<double>(scenes.size());
  return std::sqrt(squares * count / (count - 1)) / static_cast<double>(objects);
}

std::vector<double> ranks(std::span<const double> values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> rank(values.size());
  for (std::size_t i = 0; i < order.size();) {
    std::size_t end = i;
    while (end < order.size() && values[order[end]] == values[order[i]]) ++end;
    for (std::size_t k = i; k < end; ++k) rank[order[k]] = (static_cast<double>(i + end) - 1) / 2;
    i = end;
  }
  return rank;
}

}  // namespace

const std::vector<std::string>& paper_models() {
  static const std::vector<std::string> kModels{"cylinder_paper", "sheaf_paper", "sheaf", "carve_paper", "clip_paper"};
  return kModels;
}

CellJudgement judge_cell(std::span<const ScenePair> scenes, std::optional<std::uint32_t> views) {
  const std::vector<Pair> pairs = pairs_at(scenes, views);
  CellJudgement cell;
  cell.views = views;
  cell.objects = pairs.size();
  std::vector<double> rivals(paper_models().size());
  const auto count = static_cast<double>(pairs.size());
  for (const Pair& pair : pairs) {
    cell.recklessness += 100 * pair.hybrid.recklessness / count;
    cell.paranoia += 100 * pair.hybrid.paranoia / count;
    for (std::size_t i = 0; i < rivals.size(); ++i) rivals[i] += pair.rivals[i] / count;
  }
  const auto best = static_cast<std::size_t>(std::min_element(rivals.begin(), rivals.end()) - rivals.begin());
  cell.rival = paper_models()[best];
  cell.rival_sum = rivals[best];
  cell.difference = cell.sum() - cell.rival_sum;
  std::map<std::size_t, std::vector<double>> by_scene;
  for (const Pair& pair : pairs) by_scene[pair.scene].push_back(sum_of(pair.hybrid) - pair.rivals[best]);
  if (by_scene.size() < 2) throw std::runtime_error("a judgement needs two scenes or more with objects seen so often");
  cell.standard_error = error_by_scenes(by_scene, cell.difference, pairs.size());
  return cell;
}

ModelMeans means_of_model(std::span<const host::Evaluation> scenes, const std::string& model,
                          std::optional<std::uint32_t> views) {
  ModelMeans sum;
  double objects = 0;
  for (const host::Evaluation& scene : scenes) {
    for (const host::ObjectEvaluation& object : scene.objects) {
      const host::Cut* cut = cut_at(scene, object.truth, views);
      if (cut == nullptr) continue;
      const host::Score score = score_of(*cut, model);
      sum.recklessness += 100 * score.recklessness;
      sum.paranoia += 100 * score.paranoia;
      sum.iou += 100 * score.iou;
      ++objects;
    }
  }
  if (objects == 0) throw std::runtime_error("no object was seen so often");
  return {sum.recklessness / objects, sum.paranoia / objects, sum.iou / objects};
}

std::vector<Confidence> confidences(std::span<const host::Evaluation> scenes) {
  std::vector<Confidence> fits;
  for (const host::Evaluation& scene : scenes) {
    for (const host::ObjectEvaluation& object : scene.objects) {
      for (const host::Cut& cut : object.cuts) {
        if (cut.models.empty()) continue;
        const host::Score score = score_of(cut, kHybrid);
        // The hull has R = 0, so 1 - P of it is the footprint's share: what the best outline has of its own area.
        const double footprint_share = 1 - score_of(cut, kHullLimit).paranoia;
        fits.push_back({cut.confidence, score.recklessness + 1 - (1 - score.paranoia) / footprint_share});
      }
    }
  }
  return fits;
}

double ConfidenceBin::promised() const { return std::min(1.0, 1.05 * (1 - reported)); }

std::vector<ConfidenceBin> bins_of(std::span<const Confidence> fits) {
  constexpr std::array<double, 7> kEdges{0, 0.2, 0.4, 0.6, 0.75, 0.9, 1.01};
  std::vector<ConfidenceBin> bins;
  for (std::size_t i = 0; i + 1 < kEdges.size(); ++i) {
    ConfidenceBin bin{kEdges[i], kEdges[i + 1], 0, 0, 0};
    for (const Confidence& fit : fits) {
      if (fit.reported < bin.from || fit.reported >= bin.to) continue;
      ++bin.fits;
      bin.reported += fit.reported;
      bin.excess += fit.excess;
    }
    if (bin.fits == 0) continue;
    bin.reported /= static_cast<double>(bin.fits);
    bin.excess /= static_cast<double>(bin.fits);
    bins.push_back(bin);
  }
  return bins;
}

double spearman(std::span<const Confidence> fits) {
  std::vector<double> doubt;
  std::vector<double> excess;
  for (const Confidence& fit : fits) {
    doubt.push_back(-fit.reported);
    excess.push_back(fit.excess);
  }
  const std::vector<double> a = ranks(doubt);
  const std::vector<double> b = ranks(excess);
  const double mean = (static_cast<double>(fits.size()) - 1) / 2;
  double ab = 0, aa = 0, bb = 0;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    ab += (a[i] - mean) * (b[i] - mean);
    aa += (a[i] - mean) * (a[i] - mean);
    bb += (b[i] - mean) * (b[i] - mean);
  }
  return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : 0;
}

}  // namespace fencepost::test
