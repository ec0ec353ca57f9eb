// Shared by the charts of several figures.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/paper/algorithm.hpp"
#include "host/paper/chart.hpp"

namespace fencepost::host {

/// A line in the algorithm's colour, with its name.
ChartSeries series_of(const Algorithm& algorithm);

/// A line of swatches, for drawings without a legend of their own.
std::string algorithm_legend();

/// Mean of y where x is in each of `bins` equal parts of [low, high]; parts of fewer than `least` points are left out.
/// At the mean x of the part's points.
std::vector<Point> binned_means(const std::vector<Point>& points, double low, double high, int bins,
                                std::size_t least = 1);

struct Slope {
  double value = 0;
  double sigma = 0;  ///< its standard error, by the residuals

  /// True if it is below zero by more than chance would have it: by two standard errors.
  [[nodiscard]] bool falls() const { return value < -2 * sigma; }
};

/// Slope of the least-squares line, x being a share. Empty if nothing can be fitted: fewer than three points, or all x
/// are the same but for rounding.
std::optional<Slope> slope(const std::vector<Point>& points);

/// The points whose x is in one of the equal parts of a range.
struct BinStatistics {
  double x = 0;  ///< mean
  std::size_t count = 0;
  double mean = 0;
  double deviation = 0;  ///< standard, of the points
};
std::vector<BinStatistics> bin_statistics(const std::vector<Point>& points, double low, double high, int bins);

/// Spearman's rank correlation, ties averaged; 0 for fewer than two points.
double rank_correlation(const std::vector<Point>& points);

}  // namespace fencepost::host
