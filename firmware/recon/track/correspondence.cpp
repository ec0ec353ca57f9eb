#include "firmware/recon/track/correspondence.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "firmware/recon/track/tuning.hpp"

namespace fencepost::recon {
namespace {

constexpr float kBoxSides = 4;

int reach_of(const PredictedLine& line) { return static_cast<int>(kGateSigmas) * line.sigma; }

// Squared deviation in units of three sigmas, at most 1: a lost piece is no worse than that.
float cost_of_side(std::int16_t seen, End end, const PredictedLine& line) {
  if (!is_edge(end) || line.sigma == 0) return kCostOfUnknownSide;
  const int pixels = std::abs(seen - line.at);
  if (pixels == 0) return 0;
  if (pixels >= reach_of(line)) return 1;
  const float off = static_cast<float>(pixels) / static_cast<float>(reach_of(line));
  return off * off;
}

bool agrees(std::int16_t seen, const PredictedLine& line) {
  return line.sigma > 0 && std::abs(seen - line.at) <= reach_of(line);
}

// Three sides where they should be: the fourth is where a segment was lost or another one grew into it.
bool all_but_one_agree(const Prediction& prediction, const Observation& seen) {
  int sides = 0;
  if (is_edge(seen.left) && agrees(seen.left_column, prediction.left)) ++sides;
  if (is_edge(seen.right) && agrees(seen.right_column, prediction.right)) ++sides;
  if (is_edge(seen.top) && agrees(seen.box.y1, prediction.top)) ++sides;
  if (is_edge(seen.bottom) && agrees(seen.box.y2, prediction.bottom)) ++sides;
  return sides >= 3;
}

// The outer end of one of two objects in a blob: where it should be, if it is seen and its place is known.
bool has_outer_end(const Prediction& prediction, std::int16_t seen, End end, const PredictedLine& line) {
  return !is_edge(end) || !(prediction.depth > 0) || agrees(seen, line);
}

// The deviation of an end, and its tolerance.
struct OffBy {
  std::int32_t pixels = 0;
  std::int32_t tolerance = 1;
  [[nodiscard]] bool within() const { return pixels <= tolerance; }
  [[nodiscard]] float share() const { return static_cast<float>(pixels) / static_cast<float>(tolerance); }
};

// No farther off on average than their tolerances. Both ends mostly agree on that, and then nothing is divided.
bool tolerable(const Prediction& prediction, const Observation& seen) {
  const OffBy left{std::abs(seen.left_column - prediction.left.at), prediction.left_tolerance};
  const OffBy right{std::abs(seen.right_column - prediction.right.at), prediction.right_tolerance};
  if (!is_edge(seen.left)) return right.within();
  if (!is_edge(seen.right) || left.within() == right.within()) return left.within();
  return left.share() + right.share() <= 2;
}

// An object without a distance: possible anywhere on its bearing, likelier near where it was seen last.
std::uint8_t cost_on_bearing(const Prediction& prediction, const Observation& seen) {
  const int twice_center = seen.twice_middle();
  const int width = seen.columns();
  const int low = std::min(prediction.left.at, prediction.right.at) - prediction.left_tolerance;
  const int high = std::max(prediction.left.at, prediction.right.at) + prediction.right_tolerance;
  if (twice_center <= 2 * low - width || twice_center >= 2 * high + width) return kImpossible;
  const float off = 0.5F * static_cast<float>(twice_center) - static_cast<float>(prediction.left.at);
  const auto reach = static_cast<float>(prediction.left_tolerance + prediction.right_tolerance + width);
  const float share = std::min(1.0F, std::fabs(off) / reach);
  const float cost = share + cost_of_side(seen.box.y1, seen.top, prediction.top) +
                     cost_of_side(seen.box.y2, seen.bottom, prediction.bottom);
  return static_cast<std::uint8_t>(kUnknownCostNear + (kUnknownCost - kUnknownCostNear) / 3 * cost);
}

// A bearing points at the middle of the object, wherever its ends are.
std::uint8_t cost_of_middle(const Prediction& prediction, const Observation& seen) {
  const int twice_off = std::abs(seen.twice_middle() - prediction.left.at - prediction.right.at);
  const int twice_tolerance = prediction.left_tolerance + prediction.right_tolerance;
  if (twice_off > twice_tolerance) return kImpossible;
  const float share = static_cast<float>(twice_off) / static_cast<float>(twice_tolerance);
  return static_cast<std::uint8_t>(kCostScale / kBoxSides * 2 * (share * share + kCostOfUnknownSide));
}

}  // namespace

std::uint8_t match_cost(const Prediction& prediction, const Observation& seen) {
  if (!prediction.possible) return kImpossible;
  if (!(prediction.depth > 0)) return cost_on_bearing(prediction, seen);
  if (seen.bearing) return cost_of_middle(prediction, seen);
  if (seen.no_edge()) return overlaps(prediction, seen) ? kUnknownCost : kImpossible;
  if (!tolerable(prediction, seen) && !all_but_one_agree(prediction, seen)) return kImpossible;
  // In sigmas: decides which pair is better. Rows never forbid a pair: the object may hang in the air.
  const float cost = cost_of_side(seen.left_column, seen.left, prediction.left) +
                     cost_of_side(seen.right_column, seen.right, prediction.right) +
                     cost_of_side(seen.box.y1, seen.top, prediction.top) +
                     cost_of_side(seen.box.y2, seen.bottom, prediction.bottom);
  return static_cast<std::uint8_t>(kCostScale / kBoxSides * cost);
}

std::uint8_t cost_with_ids(std::uint8_t cost, std::uint8_t last_track, std::uint8_t track, std::uint8_t id_cost) {
  if (track == 0 || last_track == 0 || cost == kImpossible) return cost;
  if (track == last_track) return static_cast<std::uint8_t>(cost - std::min(cost, id_cost));
  return static_cast<std::uint8_t>(std::min(cost + id_cost, kImpossible - 1));
}

bool covers(const Prediction& prediction, const Observation& seen) {
  return prediction.depth > 0 && seen.left_column > prediction.left.at - reach_of(prediction.left) &&
         seen.right_column < prediction.right.at + reach_of(prediction.right);
}

bool has_middle_of(const Prediction& prediction, const Observation& seen) {
  const int twice_middle = seen.twice_middle();
  return twice_middle >= 2 * (prediction.left.at - prediction.left.sigma) &&
         twice_middle <= 2 * (prediction.right.at + prediction.right.sigma);
}

EndsOff ends_off(const Prediction& prediction, const Observation& seen, bool inside) {
  if (!(prediction.depth > 0)) return {};
  const auto off = [&](End end, int beyond, const PredictedLine& line) {
    if (!is_edge(end) || line.sigma == 0) return false;
    const int reach = reach_of(line) + 1;
    return beyond > reach || (inside && beyond < -reach);
  };
  return {off(seen.left, prediction.left.at - seen.left_column, prediction.left),
          off(seen.right, seen.right_column - prediction.right.at, prediction.right)};
}

void compare_ends(ObjectCore& object, const Prediction& prediction, const Observation& seen, EndsOff open) {
  const auto count = [](std::int8_t before, std::int16_t column, const PredictedLine& line) -> std::int8_t {
    if (line.sigma == 0 || std::abs(column - line.at) <= reach_of(line) + 1) return 0;
    constexpr int kMax = 100;
    const int step = column < line.at ? -1 : 1;
    return static_cast<std::int8_t>(step * before > 0 ? std::clamp(before + step, -kMax, kMax) : step);
  };
  if (!(prediction.depth > 0)) return;
  if (is_edge(seen.left)) {
    object.left_off = open.left ? std::int8_t{0} : count(object.left_off, seen.left_column, prediction.left);
  }
  if (is_edge(seen.right)) {
    object.right_off = open.right ? std::int8_t{0} : count(object.right_off, seen.right_column, prediction.right);
  }
}

bool compare_foot(ObjectCore& object, const Observation& seen, bool stands) {
  if (seen.bearing) return false;
  const bool jumped = stands && object.foot_row > 0 && std::abs(seen.box.y2 - object.foot_row) > kFootJump;
  if (!jumped) object.foot_row = seen.box.y2;
  return jumped && is_edge(seen.bottom);
}

bool overlaps(const Prediction& prediction, const Observation& seen) {
  return prediction.possible && seen.right_column > std::min(prediction.left.at, prediction.right.at) &&
         seen.left_column < std::max(prediction.left.at, prediction.right.at);
}

bool stands_behind(const Observation& seen, const Prediction& prediction) {
  if (prediction.foot_row > 0) return is_edge(seen.bottom) && seen.box.y2 < prediction.foot_row - kFootJump;
  const PredictedLine& foot = prediction.bottom;
  return foot.sigma > 0 && is_edge(seen.bottom) && seen.box.y2 < foot.at - kFootSigmas * foot.sigma;
}

bool stands_elsewhere(const Prediction& prediction, const Observation& seen) {
  if (prediction.foot_row <= 0 || !is_edge(seen.bottom)) return false;
  if (std::abs(seen.box.y2 - prediction.foot_row) <= kFootJump) return false;
  if (prediction.refuted) return true;
  const PredictedLine& top = prediction.top;
  const bool same_top = top.sigma > 0 ? agrees(seen.box.y1, top) : !is_edge(seen.top);
  return !same_top || !covers(prediction, seen);
}

bool shows_both(const Prediction& left, const Prediction& right, const Observation& seen) {
  if (!(left.depth > 0 || right.depth > 0) || !left.possible || !right.possible) return false;
  if (seen.no_edge()) return false;
  if (!has_outer_end(left, seen.left_column, seen.left, left.left)) return false;
  if (!has_outer_end(right, seen.right_column, seen.right, right.right)) return false;
  if (left.depth > 0 && seen.right_column - left.right.at <= reach_of(left.right) + 1) return false;
  if (right.depth > 0 && right.left.at - seen.left_column <= reach_of(right.left) + 1) return false;
  if (!(left.depth > 0)) return left.left.at > seen.left_column && left.left.at < right.left.at;
  if (!(right.depth > 0)) return right.left.at < seen.right_column && right.left.at > left.right.at;
  const Prediction& nearer = left.depth < right.depth ? left : right;
  if (is_edge(seen.bottom) && nearer.bottom.sigma > 0 && !agrees(seen.box.y2, nearer.bottom)) return false;
  return right.left.at - left.right.at <= reach_of(left.right) + reach_of(right.left) + 2;
}

bool hides_end(const Prediction& nearer, const Prediction& behind, std::int16_t column, int side) {
  if (!nearer.hides) return false;
  const PredictedLine& inner = side < 0 ? nearer.right : nearer.left;
  const PredictedLine& outer = side < 0 ? nearer.left : nearer.right;
  const int past_inner = side < 0 ? inner.at - column : column - inner.at;
  const int past_outer = side < 0 ? column - outer.at : outer.at - column;
  // Whole numbers first: most objects are elsewhere in the image.
  if (past_inner < -(inner.sigma + 1) || past_outer <= 0) return false;
  return nearer.depth > 0 && behind.depth > 0 && nearer.depth < kSameDepth * behind.depth;
}

}  // namespace fencepost::recon
