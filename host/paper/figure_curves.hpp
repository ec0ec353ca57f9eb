// What the charts of several figures share.
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

/// Slope of the least-squares line, x being a share; empty if all x are the same but for rounding: nothing can be
/// fitted.
std::optional<double> slope(const std::vector<Point>& points);

/// Spearman's rank correlation, ties averaged; 0 for fewer than two points.
double rank_correlation(const std::vector<Point>& points);

}  // namespace fencepost::host
