// Matches the objects of a result to the true objects.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "host/result/result.hpp"
#include "host/scene/scene.hpp"

namespace fencepost::host {

/// Margin in m. An object may match a true one of its signature within the circle about the footprint's centroid
/// through its farthest vertex, enlarged by this margin.
inline constexpr double kMatchMargin = 0.25;

/// The object's position: the cylinder's centre, else the centroid of its largest area; empty if it has neither.
std::optional<Point> place_of(const ObjectResult& object);

/// For each object the index of its true object. One to one, with the least sum of distance / allowed distance, where
/// an unmatched object counts 1. Confirmed objects choose first, tentative ones among the rest.
std::vector<std::optional<std::size_t>> match_objects(const std::vector<ObjectResult>& objects, const Scene& truth);

}  // namespace fencepost::host
