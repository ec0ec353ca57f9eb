#include "tests/studies/tables/table_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tests/studies/tables/quality_run.hpp"
#include "tests/studies/tables/reference_scene.hpp"

namespace fencepost::test {
namespace {

std::string head(const std::string& title) {
  std::string text = title + "\n\n| model |";
  for (const std::uint32_t views : kTableViews)
    text += fmt::format(" {}{} |", views == kTableViews.front() ? "n=" : "", views);
  return text + fmt::format(" {} |\n|---|---|---|---|---|---|", kTourViews);
}

std::uint32_t views_of(const ReferenceCell& cell) { return cell.views.value_or(kTourViews); }

std::string_view mark(const ComparedCell& cell) {
  if (cell.fails()) return " **";
  return cell.misses() ? " *" : "";
}

/// The cells of one model from `first` on.
std::span<const ComparedCell> row_from(const std::vector<ComparedCell>& cells, std::size_t first) {
  std::size_t end = first;
  while (end < cells.size() && cells[end].reference.model == cells[first].reference.model) ++end;
  return {cells.data() + first, end - first};
}

template <class Test>
std::ptrdiff_t count(const Compared& compared, Test test) {
  return std::count_if(compared.cells.begin(), compared.cells.end(), test);
}

}  // namespace

std::string level_table(const NoiseLevel& level, const std::string& flags, const host::Summary& summary) {
  std::string text = head(fmt::format("**{}** (R / P / IoU, %; {} flags)", level.name, flags));
  std::string model;
  double worst_early = 0;
  double worst_end = 0;
  for (const host::SummaryRow& row : summary.rows) {
    if (row.model != model) text += fmt::format("\n| {} |", row.model);
    model = row.model;
    text += fmt::format(" {:.0f} / {:.0f} / {:.0f} |", 100 * row.recklessness.mean, 100 * paranoia_with_empty(row),
                        100 * row.iou.mean);
    double& worst = row.views ? worst_early : worst_end;
    for (const host::Mean* mean : {&row.recklessness, &row.paranoia}) {
      worst = std::max(worst, 100 * mean->standard_error.value_or(0));
    }
  }
  text += fmt::format("\n\n{} objects of {} scenes: {} missed, {} phantoms, {} identity swaps; ", summary.objects,
                      summary.logs, summary.missed, summary.phantoms, summary.swaps.value_or(0));
  return text +
         fmt::format("standard error of R and P at most {:.1f} points, {:.1f} at the end.\n\n", worst_early, worst_end);
}

std::string comparison_table(const NoiseLevel& level, std::span<const Compared> compared) {
  std::string text = head(fmt::format("**{}** beside the reference (R / P, %)", level.name));
  const std::vector<ComparedCell>& all = compared.front().cells;
  for (std::size_t first = 0; first < all.size(); first += row_from(all, first).size()) {
    text += fmt::format("\n| {}, reference |", all[first].reference.model);
    for (const ComparedCell& cell : row_from(all, first)) {
      text += fmt::format(" {:.1f} / {:.1f} |", cell.reference.recklessness, cell.reference.paranoia);
    }
    for (const Compared& kind : compared) {
      text += fmt::format("\n| {} flags |", kind.flags);
      for (const ComparedCell& cell : row_from(kind.cells, first)) {
        text += fmt::format(" {:.1f} / {:.1f}{} |", cell.recklessness, cell.paranoia, mark(cell));
      }
    }
  }
  return text + "\n\n";
}

std::string verdict(const Compared& compared) {
  const auto misses = count(compared, [](const ComparedCell& cell) { return cell.misses(); });
  const auto fails = count(compared, [](const ComparedCell& cell) { return cell.fails(); });
  std::string text;
  if (misses > 0) text = "| noise | model | n | reference R / P | R / P | R+P worse by | standard error |\n";
  if (misses > 0) text += "|---|---|---|---|---|---|---|\n";
  for (const ComparedCell& cell : compared.cells) {
    if (!cell.misses()) continue;
    const ReferenceCell& reference = cell.reference;
    text += fmt::format("| {} | {} | {} | {:.1f} / {:.1f} | {:.1f} / {:.1f} | {:.1f}{} | {:.1f} |\n", reference.level,
                        reference.model, views_of(reference), reference.recklessness, reference.paranoia,
                        cell.recklessness, cell.paranoia, cell.worse_by(), mark(cell), cell.error);
  }
  text += fmt::format(
      "\n{} flags: of {} cells {} are worse than the reference by more than {} points in R+P (*), {} by "
      "{} standard errors more (**). ",
      compared.flags, compared.cells.size(), misses, kPointsAllowed, fails, kErrorsAllowed);
  const auto reckless = count(compared, [](const ComparedCell& cell) {
    return cell.recklessness - cell.reference.recklessness > kPointsAllowed;
  });
  const auto paranoid = count(
      compared, [](const ComparedCell& cell) { return cell.paranoia - cell.reference.paranoia > kPointsAllowed; });
  return text + fmt::format("R alone is worse by more in {} cells, P alone in {}.\n\n", reckless, paranoid);
}

}  // namespace fencepost::test
