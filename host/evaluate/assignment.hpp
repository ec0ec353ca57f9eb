// The cheapest way to pair rows with columns, each at most once.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace fencepost::host {

/// A pair that cannot be.
inline constexpr double kNeverPaired = std::numeric_limits<double>::infinity();

/// `costs[row][column]`, all rows of the same size; a row that stays alone costs `alone`. For each row its column, so
/// that the sum is least. Hungarian method, rows^2 * (rows + columns) steps; the same costs give the same pairs.
std::vector<std::optional<std::size_t>> pair_cheapest(const std::vector<std::vector<double>>& costs, double alone);

}  // namespace fencepost::host
