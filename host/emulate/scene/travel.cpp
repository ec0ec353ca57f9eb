#include "host/emulate/scene/travel.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fencepost::emulate {
namespace {

// m: rounding of two positions in units of 0.1 mm, and of the heading between them.
constexpr double kRounding = 1.5e-4;

double arc_by_chord(double half_turn) { return std::abs(half_turn) < 1e-9 ? 1 : half_turn / std::sin(half_turn); }

}  // namespace

TravelLog::TravelLog(std::span<const sensor::OdometrySample> poses) {
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (i == 0) {
      knots_.push_back({poses[0].t, 0, 0});
      continue;
    }
    const sensor::OdometrySample& from = poses[i - 1];
    const sensor::OdometrySample& to = poses[i];
    const double turn = std::remainder((to.heading - from.heading).to_double(), 2 * std::numbers::pi);
    const double middle = from.heading.to_double() + turn / 2;
    const double dx = (to.x - from.x).to_double();
    const double dy = (to.y - from.y).to_double();
    const double ahead = dx * std::cos(middle) + dy * std::sin(middle);
    sideways_ += std::max(0.0, std::abs(dy * std::cos(middle) - dx * std::sin(middle)) - kRounding);
    const Knot& last = knots_.back();
    knots_.push_back({to.t, last.distance + ahead * arc_by_chord(turn / 2), last.heading + turn});
  }
}

Travel TravelLog::at(base::Time t) const {
  if (knots_.empty()) return {};
  const auto later = [](base::Time time, const Knot& knot) { return time < knot.t; };
  const auto after = std::upper_bound(knots_.begin(), knots_.end(), t, later);
  if (after == knots_.begin()) return {};
  if (after == knots_.end()) return {knots_.back().distance, knots_.back().heading, 0, 0};
  const Knot& before = *(after - 1);
  const double span = base::Duration(after->t - before.t).to_double();
  const double share = base::Duration(t - before.t).to_double() / span;
  const double distance = after->distance - before.distance;
  const double turn = after->heading - before.heading;
  return {before.distance + share * distance, before.heading + share * turn, distance / span, turn / span};
}

}  // namespace fencepost::emulate
