// The tangents that one view gives of an outline's convex hull.
#pragma once

#include <cstdint>

#include "firmware/recon/geometry.hpp"
#include "firmware/recon/observe/sighting.hpp"

namespace fencepost::recon {

/// h(normal) = bound is known to sigma: the support function of the object, sampled once. Local frame, metres.
struct Tangent {
  HalfPlane line;
  float sigma = 0;
  bool lower_bound = false;  ///< h(normal) >= bound: seen so far, and then it goes on where it is not seen
};

/// At most three: the two ends of a blob, and its foot where the camera's height and pitch are known.
struct ViewTangents {
  enum Which : std::uint8_t { kLeft = 1, kRight = 2, kFront = 4 };
  static constexpr unsigned kBits = 3;
  Tangent left;
  Tangent right;
  Tangent front;
  float straight = 0;            ///< m, sigma of `front` if that is a lower bound because the thing goes on beyond the
                                 ///< image, and as an edge if it goes on straight; 0: nothing is known of that
  std::uint8_t present = 0;      ///< bits of Which
  std::uint8_t lower_bound = 0;  ///< bits of Which: not an edge but a lower bound
};

/// `distance`: from the lens to the object's middle (m). A lower bound or an ambiguous end is not present but a bound
/// from below; an occluded one is neither.
ViewTangents tangents_of(const Sighting& sighting, MapPoint origin, float distance, const MeasurementNoise& noise);

}  // namespace fencepost::recon
