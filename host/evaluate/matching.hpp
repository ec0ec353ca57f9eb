// Matches the objects of a result to the true objects.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "host/result/result.hpp"
#include "host/scene/scene.hpp"

namespace fencepost::host {

/// An object may be matched to a true one of its signature if its position lies within the circle around the
/// footprint's centroid through its farthest vertex, enlarged by this much (m).
inline constexpr double kMatchMargin = 0.25;

/// The object's position: the cylinder's centre, else the centroid of its largest area; empty if it has neither.
std::optional<Point> place_of(const ObjectResult& object);

/// For each object the index of its true object. One to one, so that the sum of distance / allowed distance is least,
/// where an object left over counts 1; objects that were confirmed choose first, tentative ones among the rest.
std::vector<std::optional<std::size_t>> match_objects(const std::vector<ObjectResult>& objects, const Scene& truth);

}  // namespace fencepost::host
