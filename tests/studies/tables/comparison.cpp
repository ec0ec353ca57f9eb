#include "tests/studies/tables/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "host/evaluate/evaluate.hpp"
#include "tests/studies/tables/quality_run.hpp"

namespace fencepost::test {
namespace {

/// One scene's means of one cell.
struct SceneMeans {
  double objects = 0;
  double recklessness = 0;
  double paranoia = 0;
  [[nodiscard]] double sum() const { return recklessness + paranoia; }
};

std::vector<SceneMeans> means_of(std::span<const host::Summary> scenes, const ReferenceCell& cell) {
  std::vector<SceneMeans> means;
  for (const host::Summary& scene : scenes) {
    const auto row = std::find_if(scene.rows.begin(), scene.rows.end(), [&](const host::SummaryRow& candidate) {
      return candidate.model == cell.model && candidate.views == cell.views;
    });
    if (row == scene.rows.end()) throw std::runtime_error("model " + cell.model + " was not measured");
    const auto objects = static_cast<double>(row->recklessness.n);
    if (objects > 0) means.push_back({objects, 100 * row->recklessness.mean, 100 * paranoia_with_empty(*row)});
  }
  if (means.size() < 2) throw std::runtime_error("a comparison needs two scenes or more with " + cell.model);
  return means;
}

ComparedCell compare_cell(const ReferenceCell& reference, const std::vector<SceneMeans>& scenes) {
  ComparedCell cell{reference};
  double objects = 0;
  for (const SceneMeans& scene : scenes) objects += scene.objects;
  for (const SceneMeans& scene : scenes) {
    cell.recklessness += scene.objects / objects * scene.recklessness;
    cell.paranoia += scene.objects / objects * scene.paranoia;
  }
  double squares = 0;
  for (const SceneMeans& scene : scenes) {
    const double off = scene.objects / objects * (scene.sum() - cell.recklessness - cell.paranoia);
    squares += off * off;
  }
  const auto count = static_cast<double>(scenes.size());
  const double variance = squares * count / (count - 1);
  cell.error = std::sqrt(variance * (1 + count / kReferenceScenes));
  return cell;
}

}  // namespace

double paranoia_with_empty(const host::SummaryRow& row) {
  const auto shapes = static_cast<double>(row.paranoia.n);
  const auto empty = static_cast<double>(row.empty);
  return row.recklessness.n == 0 ? 0 : (row.paranoia.mean * shapes + empty) / (shapes + empty);
}

std::vector<ComparedCell> compare(std::string_view level, std::span<const host::Evaluation> scenes,
                                  std::span<const ReferenceCell> reference) {
  std::vector<host::Summary> summaries;
  for (const host::Evaluation& scene : scenes) summaries.push_back(host::summarise({&scene, 1}, kTableViews));
  std::vector<ComparedCell> cells;
  for (const ReferenceCell& cell : reference) {
    if (cell.level == level) cells.push_back(compare_cell(cell, means_of(summaries, cell)));
  }
  return cells;
}

}  // namespace fencepost::test
