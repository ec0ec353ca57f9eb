#include "host/paper/figure_curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "host/report/markup.hpp"

namespace fencepost::host {
namespace {

/// 1 for the least; equal values share the mean of their ranks.
std::vector<double> ranks_of(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> ranks(values.size());
  for (std::size_t i = 0; i < order.size();) {
    std::size_t end = i;
    while (end < order.size() && values[order[end]] == values[order[i]]) ++end;
    const double rank = static_cast<double>(i + end + 1) / 2;
    for (; i < end; ++i) ranks[order[i]] = rank;
  }
  return ranks;
}

struct Moments {
  double xx = 0;
  double xy = 0;
  double yy = 0;
};

Moments central_moments(const std::vector<Point>& points) {
  Point mean;
  for (const Point& p : points) mean = {mean.x + p.x, mean.y + p.y};
  const auto n = static_cast<double>(points.size());
  mean = {mean.x / n, mean.y / n};
  Moments moments;
  for (const Point& p : points) {
    moments.xx += (p.x - mean.x) * (p.x - mean.x);
    moments.xy += (p.x - mean.x) * (p.y - mean.y);
    moments.yy += (p.y - mean.y) * (p.y - mean.y);
  }
  return moments;
}

}  // namespace

ChartSeries series_of(const Algorithm& algorithm) {
  ChartSeries series;
  series.name = algorithm.label;
  series.colour = algorithm.colour;
  series.dash = algorithm.dash;
  return series;
}

std::string algorithm_legend() {
  std::string html = R"(<p class="levels"><span><i style="background:#f2d024"></i>true footprint</span>)";
  for (const Algorithm& algorithm : algorithms()) {
    html += fmt::format(
        R"(<span><svg width="30" height="12" aria-hidden="true"><path d="M1 6h28" stroke="{}" stroke-width="2.6" stroke-dasharray="{}"/></svg>{}</span>)",
        algorithm.colour, algorithm.dash.empty() ? "none" : algorithm.dash, markup::escaped(algorithm.label));
  }
  return html + "</p>\n";
}

std::vector<BinStatistics> bin_statistics(const std::vector<Point>& points, double low, double high, int bins) {
  std::vector<std::vector<Point>> all(static_cast<std::size_t>(bins));
  for (const Point& p : points) {
    if (!(p.x >= low && p.x <= high)) continue;
    all[static_cast<std::size_t>(std::min(bins - 1.0, std::floor((p.x - low) / (high - low) * bins)))].push_back(p);
  }
  std::vector<BinStatistics> statistics;
  for (const std::vector<Point>& bin : all) {
    if (bin.empty()) continue;
    BinStatistics& one = statistics.emplace_back();
    one.count = bin.size();
    const auto n = static_cast<double>(bin.size());
    for (const Point& p : bin) {
      one.x += p.x / n;
      one.mean += p.y / n;
    }
    if (bin.size() > 1) one.deviation = std::sqrt(central_moments(bin).yy / (n - 1));
  }
  return statistics;
}

std::vector<Point> binned_means(const std::vector<Point>& points, double low, double high, int bins,
                                std::size_t least) {
  std::vector<Point> means;
  for (const BinStatistics& bin : bin_statistics(points, low, high, bins)) {
    if (bin.count >= least) means.push_back({bin.x, bin.mean});
  }
  return means;
}

std::optional<Slope> slope(const std::vector<Point>& points) {
  constexpr double kMinSpread = 1e-6;  // of shares; less is the rounding of equal ones
  const auto [least, greatest] =
      std::minmax_element(points.begin(), points.end(), [](const Point& a, const Point& b) { return a.x < b.x; });
  if (points.size() < 3 || greatest->x - least->x < kMinSpread) return std::nullopt;
  const Moments moments = central_moments(points);
  const double value = moments.xy / moments.xx;
  const double residuals = std::max(0.0, moments.yy - value * moments.xy);
  return Slope{value, std::sqrt(residuals / (static_cast<double>(points.size()) - 2) / moments.xx)};
}

double rank_correlation(const std::vector<Point>& points) {
  if (points.size() < 2) return 0;
  std::vector<double> x;
  std::vector<double> y;
  for (const Point& p : points) {
    x.push_back(p.x);
    y.push_back(p.y);
  }
  const std::vector<double> rx = ranks_of(x);
  const std::vector<double> ry = ranks_of(y);
  std::vector<Point> ranks;
  for (std::size_t i = 0; i < points.size(); ++i) ranks.push_back({rx[i], ry[i]});
  const Moments moments = central_moments(ranks);
  return moments.xx > 0 && moments.yy > 0 ? moments.xy / std::sqrt(moments.xx * moments.yy) : 0;
}

}  // namespace fencepost::host
