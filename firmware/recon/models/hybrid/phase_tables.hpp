// Values that depend only on a cluster's place in its sector, one for each of kPhases places. The compiler computes the
// tables, because every pass of every fit reads them.
#pragma once

#include <array>
#include <cstddef>

#include "firmware/recon/models/hybrid/node_directions.hpp"

namespace fencepost::recon {

inline constexpr std::size_t kPhases = 128;  ///< places in a sector

/// The middle of a place, as a share of the sector.
constexpr float phase_at(std::size_t place) { return (static_cast<float>(place) + 0.5F) / static_cast<float>(kPhases); }

/// Cosine and sine of the angle from the sector's beginning.
struct Turn {
  float cosine = 1;
  float sine = 0;
};
template <std::size_t kSectors>
inline constexpr auto kTurns = [] {
  std::array<Turn, kPhases> turns{};
  for (std::size_t place = 0; place < kPhases; ++place) {
    const float angle = phase_at(place) * node_step(kSectors).angle;
    turns[place] = {small_cosine(angle), small_sine(angle)};
  }
  return turns;
}();

/// Weights of the support values at both ends of a sector in one between them, of 64 sectors.
struct EndShares {
  float first = 1;
  float second = 0;
};
inline constexpr auto kEndShares = [] {
  constexpr NodeStep kStep = node_step(kDirections);
  std::array<EndShares, kPhases> shares{};
  for (std::size_t place = 0; place < kPhases; ++place) {
    const float angle = phase_at(place) * kStep.angle;
    shares[place] = {small_sine(kStep.angle - angle) / kStep.sine, small_sine(angle) / kStep.sine};
  }
  return shares;
}();

}  // namespace fencepost::recon
