// Which view a full store gives up. The answer is that of float arithmetic on all pairs of views; on a core without a
// float unit those would be most of a frame's work, so whole numbers first tell which few pairs can matter.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "firmware/recon/models/sheaf.hpp"
#include "hal/base/check.hpp"

namespace fencepost::recon {
namespace {

// The squares of the chords from a bearing to its nearest neighbours on either side.
struct Neighbours {
  static constexpr float kNobody = 4.0F;  // the whole circle's diameter, squared
  float left = kNobody;
  float right = kNobody;

  void consider(const Vec2& bearing, const Vec2& other, bool later) {
    const float away = (other - bearing).squaredNorm();
    const float side = cross(bearing, other);
    const bool is_left = side > 0 || (side == 0 && later);
    float& nearest = is_left ? left : right;
    nearest = std::min(nearest, away);
  }
  [[nodiscard]] float gap() const { return std::sqrt(left) + std::sqrt(right); }
};

constexpr float kUnit = 16'384;  // of a rough bearing
// A component is cut off by less than 1, so a cross product of two is off by less than 4 kUnit + 2.
constexpr std::int32_t kSideKnown = 4 * 16'384 + 2;
// A difference d is off by less than 2, its square by 4 d + 4, a squared distance D of two such by less than
// 5.7 sqrt(D) + 8, which never exceeds D / 16 + 512; that holds float rounding, too.
constexpr std::uint32_t slack(std::uint32_t away) { return away / 16 + 512; }
// A distance is off by less than 2.9, its whole root by 1 more; a gap is two of these, for two ends twice that.
constexpr std::uint32_t kGapSlack = 16;

void set_rough(RoughBearing& rough, const Vec2& bearing) {
  rough.x = static_cast<std::int16_t>(bearing.x() * kUnit);
  rough.y = static_cast<std::int16_t>(bearing.y() * kUnit);
}

std::uint32_t whole_root(std::uint32_t square) {
  std::uint32_t root = 0;
  for (std::uint32_t bit = 1U << 15U; bit > 0; bit >>= 1U) {
    if ((root | bit) * (root | bit) <= square) root |= bit;
  }
  return root;
}

constexpr std::uint32_t kNobody = 1U << 30U;
// A side is not known: its bearing has to be looked at exactly.
constexpr std::uint32_t kUnknown = 0;

struct RoughPair {
  std::uint32_t away = 0;
  std::int32_t side = 0;  ///< positive: the second is to the left of the first
  [[nodiscard]] bool side_known() const { return std::abs(side) > kSideKnown; }
};

RoughPair pair_of(const RoughBearing& a, const RoughBearing& b) {
  const std::int32_t dx = b.x - a.x;
  const std::int32_t dy = b.y - a.y;
  return {static_cast<std::uint32_t>(dx * dx + dy * dy), a.x * b.y - a.y * b.x};
}

// Squared distances to the nearest others to the right and to the left. Not kept for all bearings: that would be twice
// the scratch, and few are asked for again.
using Nearest = std::array<std::uint32_t, 2>;

Nearest nearest_of(std::span<const RoughBearing> bearings, std::size_t i) {
  Nearest nearest{kNobody, kNobody};
  const RoughBearing own = bearings[i];
  const auto consider = [&](const RoughBearing& other) {
    // Most are farther away than both in x alone: on whatever side, none of these is the nearest.
    const std::int32_t dx = other.x - own.x;
    if (static_cast<std::uint32_t>(dx * dx) > std::max(nearest[0], nearest[1])) return;
    const RoughPair pair = pair_of(own, other);
    std::uint32_t& of_side = nearest[pair.side > 0 ? 1 : 0];
    of_side = std::min(of_side, pair.side_known() ? pair.away : kUnknown);
  };
  // Neighbours in time first: they are near.
  for (std::size_t step = 1; step < bearings.size(); ++step) {
    if (i + step < bearings.size()) consider(bearings[i + step]);
    if (i >= step) consider(bearings[i - step]);
  }
  return nearest;
}

// The gap that the view would leave, at least; with twice kGapSlack on top, at most. 0: not known.
std::uint32_t least_gap(const Nearest& nearest, const SheafView& view) {
  if (nearest[0] == kUnknown || nearest[1] == kUnknown) return 0;
  const std::uint32_t gap = whole_root(nearest[0]) + whole_root(nearest[1]);
  const std::uint32_t whole = gap * static_cast<std::uint32_t>(view.true_ends());
  return whole > kGapSlack ? whole - kGapSlack : 0;
}

// Both may be off: the nearest, and one that seems farther.
bool may_be_nearest(const RoughPair& pair, const Nearest& nearest) {
  const std::uint32_t limit = nearest[pair.side > 0 ? 1 : 0];
  return limit == kUnknown || !pair.side_known() || pair.away <= limit + 3 * slack(limit);
}

float gap_of(std::size_t i, std::span<const SheafView> views, const SheafView& newcomer,
             std::span<const RoughBearing> rough) {
  const Nearest nearest = nearest_of(rough, i);
  Neighbours neighbours;
  for (std::size_t j = 0; j <= views.size(); ++j) {
    if (j == i || !may_be_nearest(pair_of(rough[i], rough[j]), nearest)) continue;
    neighbours.consider(views[i].bearing, (j < views.size() ? views[j] : newcomer).bearing, j > i);
  }
  return neighbours.gap() * static_cast<float>(views[i].true_ends());
}

}  // namespace

std::size_t view_to_give_up(std::span<const SheafView> views, const SheafView& newcomer,
                            std::span<RoughBearing> scratch) {
  FENCEPOST_CHECK(scratch.size() > views.size());
  const std::span<RoughBearing> rough = scratch.first(views.size() + 1);
  for (std::size_t i = 0; i < views.size(); ++i) set_rough(rough[i], views[i].bearing);
  set_rough(rough[views.size()], newcomer.bearing);
  std::uint32_t enough = UINT32_MAX;  // one of them leaves no larger gap than this
  for (std::size_t i = 0; i < views.size(); ++i) {
    rough[i].least_gap = least_gap(nearest_of(rough, i), views[i]);
    if (rough[i].least_gap > 0) enough = std::min(enough, rough[i].least_gap + 2 * kGapSlack);
  }
  std::optional<std::size_t> chosen;
  float smallest = 0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (rough[i].least_gap > enough) continue;
    const float gap = gap_of(i, views, newcomer, rough);
    if (chosen && !(gap < smallest)) continue;
    chosen = i;
    smallest = gap;
  }
  return chosen.value_or(0);
}

}  // namespace fencepost::recon
