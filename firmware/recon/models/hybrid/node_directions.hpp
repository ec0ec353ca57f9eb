// The directions at which an outline is kept: 64 around the circle, or every second one of them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/recon/geometry.hpp"
#include "hal/base/vectors.hpp"

namespace fencepost::recon {

inline constexpr std::size_t kDirections = 64;

/// Cosines of 2 pi k / 64. Literals, so that no compiler's arithmetic has a part in them.
inline constexpr std::array<float, kDirections / 4 + 1> kQuarterCosines = {
    1.0F,         0.995184727F, 0.98078528F,  0.956940336F,  0.923879533F, 0.881921264F,
    0.831469612F, 0.773010453F, 0.707106781F, 0.634393284F,  0.555570233F, 0.471396737F,
    0.382683432F, 0.290284677F, 0.195090322F, 0.0980171403F, 0.0F};

template <class Number>
struct CosineAndSine {
  Number cosine;
  Number sine;
};

/// Of k turns of 1/64, by a quarter of the cosines.
template <class Number, class Cosines>
constexpr CosineAndSine<Number> cosine_and_sine(const Cosines& cosines, std::size_t k) {
  constexpr std::size_t kQuarter = kDirections / 4;
  const std::size_t rest = k % kQuarter;
  const Number along = cosines[rest];
  const Number across = cosines[kQuarter - rest];
  switch (k / kQuarter % 4) {
    case 0: return {along, across};
    case 1: return {-across, along};
    case 2: return {-along, -across};
    default: return {across, -along};
  }
}

/// All of them, for which only a desk has room: nothing to decide.
template <class Number>
constexpr auto all_around(const auto& cosines) {
  std::array<CosineAndSine<Number>, base::kVectors ? kDirections : 1> all{};
  for (std::size_t k = 0; k < all.size(); ++k) all[k] = cosine_and_sine<Number>(cosines, k);
  return all;
}

/// Unit vector at k turns of 1/64.
inline Vec2 direction_at(std::size_t k) {
  static constexpr auto kAll = all_around<float>(kQuarterCosines);
  const auto [x, y] = base::kVectors ? kAll[k % kDirections] : cosine_and_sine<float>(kQuarterCosines, k);
  return {x, y};
}

/// Unit vector of node k of `nodes`, 64 or 32.
inline Vec2 node_direction(std::size_t k, std::size_t nodes) { return direction_at(k * (kDirections / nodes)); }

/// Directions as whole numbers of 1/16384.
inline constexpr std::int32_t kWholeUnit = 16'384;
struct WholeVector {
  std::int32_t x = 0;
  std::int32_t y = 0;
};

inline constexpr auto kWholeCosines = [] {
  std::array<std::int16_t, kQuarterCosines.size()> whole{};
  for (std::size_t i = 0; i < whole.size(); ++i) {
    whole[i] = static_cast<std::int16_t>(kQuarterCosines[i] * static_cast<float>(kWholeUnit) + 0.5F);
  }
  return whole;
}();

inline WholeVector whole_direction(std::size_t k, std::size_t nodes) {
  static constexpr auto kAll = all_around<std::int32_t>(kWholeCosines);
  const std::size_t at = k * (kDirections / nodes);
  const auto [x, y] = base::kVectors ? kAll[at % kDirections] : cosine_and_sine<std::int32_t>(kWholeCosines, at);
  return {x, y};
}

/// The node whose direction is nearest to `unit`.
inline std::size_t nearest_node(const Vec2& unit, std::size_t nodes) {
  const auto whole = [](float share) { return static_cast<std::int32_t>(share * static_cast<float>(kWholeUnit)); };
  const WholeVector wanted{whole(unit.x()), whole(unit.y())};
  const auto likeness = [&](std::size_t k) {
    const WholeVector direction = whole_direction(k, nodes);
    return direction.x * wanted.x + direction.y * wanted.y;
  };
  // Halving steps climb to the only summit.
  std::size_t best = 0;
  for (std::size_t step = nodes / 2; step > 0; step /= 2) {
    const std::size_t left = (best + step) % nodes;
    const std::size_t right = (best + nodes - step) % nodes;
    if (likeness(left) > likeness(best)) {
      best = left;
    } else if (likeness(right) > likeness(best)) {
      best = right;
    }
  }
  return best;
}

/// The angle between two neighbouring nodes, with its sine and cosine.
struct NodeStep {
  float angle = 0;   ///< rad
  float sine = 0;    ///< of the angle
  float cosine = 0;  ///< of the angle
};
constexpr NodeStep node_step(std::size_t nodes) {
  const std::size_t k = kDirections / nodes;
  return {6.28318531F / static_cast<float>(nodes), kQuarterCosines[kDirections / 4 - k], kQuarterCosines[k]};
}

/// Sine and cosine of an angle in [0, 0.2] rad: Taylor to x^5 and x^4, error below 1e-7.
constexpr float small_sine(float x) {
  const float q = x * x;
  return x * (1.0F - q * (1.66666667e-1F - q * 8.33333333e-3F));
}
constexpr float small_cosine(float x) {
  const float q = x * x;
  return 1.0F - q * (0.5F - q * (4.16666667e-2F - q * 1.38888889e-3F));
}

}  // namespace fencepost::recon
