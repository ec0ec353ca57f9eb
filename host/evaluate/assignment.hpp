// The assignment of rows to columns with the least cost, each used at most once.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace fencepost::host {

/// The cost of an impossible pair.
inline constexpr double kNeverPaired = std::numeric_limits<double>::infinity();

/// `costs[row][column]`, all rows of the same size; an unassigned row costs `alone`. Returns for each row its column,
/// such that the sum is least. Hungarian method, rows^2 * (rows + columns) steps; the same costs give the same pairs.
std::vector<std::optional<std::size_t>> pair_cheapest(const std::vector<std::vector<double>>& costs, double alone);

}  // namespace fencepost::host
