// The state digest: FNV-1a 64 over an explicit little-endian serialisation, chained frame to frame. Stream
// format 1 fixes what is hashed (firmware/recon/DIGEST.md).
//   - every frame: previous digest, frame number, exposure, pose, number of objects, next id;
//   - each object seen in the frame: who it is, its views, its estimate;
//   - one slot in turn (frame count modulo capacity), if used: one of its parts, another one each round.
//   - the exposure since which the robot is stationary;
//   - of the guard beside the map: how many points it has, and four of them in turn;
//   - of the check of the lens: one of its four parts in turn.
//   - in frames that the pose correction takes: the filter's pose, origin and covariance, how far odometry drifts.
//   - in these frames also one landmark in turn, with all of its covariances.
// A frame's hash is thus bounded, and nothing that differs stays hidden for longer than all parts of all slots take.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "firmware/recon/guard/guard.hpp"
#include "firmware/recon/localize/landmark_filter.hpp"
#include "firmware/recon/observe/pose_history.hpp"
#include "firmware/recon/observe/standing.hpp"
#include "firmware/recon/track/object.hpp"
#include "hal/base/fnv1a.hpp"

namespace fencepost::recon {

void hash_pose(base::Fnv1a64& hash, const MapPose& pose);
/// Hashes an object that the frame showed.
void hash_sighted(base::Fnv1a64& hash, const ObjectCore& object);
void hash_floats(base::Fnv1a64& hash, std::span<const float> values);
void hash_landmark(base::Fnv1a64& hash, const Landmark& landmark);

/// Hashes the exposure since which the robot is stationary.
inline void hash_standing(base::Fnv1a64& hash, const Standing& standing) { hash.i64(standing.since().raw); }

/// Hashes the guard; its points take turns by the number of frames so far.
template <std::size_t kCapacity>
void hash_guard(base::Fnv1a64& hash, const guard::Guard<kCapacity>& guard, std::uint32_t frames) {
  guard.hash(hash, frames);
}

/// Hashes the pose correction, unless it is off: whether it corrects, the drift gauge, the strayers, and the filter's
/// pose with its origin and covariance. One landmark follows, with all of its covariances.
template <class Correction>
void hash_correction(base::Fnv1a64& hash, const Correction& correction, std::size_t slot) {
  const auto& filter = correction.filter();
  const DriftGauge& gauge = filter.gauge();
  const std::array<float, 7> drift{gauge.factor,
                                   gauge.position,
                                   gauge.heading,
                                   gauge.surprise,
                                   gauge.usual,
                                   correction.evidence().sum(),
                                   correction.strayers().mean(slot)};
  hash.u8(correction.corrects() ? 1 : 0);
  hash_floats(hash, drift);
  for (const std::uint8_t signature : correction.strayers().signatures()) hash.u8(signature);
  hash_pose(hash, filter.at().pose);
  hash_pose(hash, filter.at().odometry);
  hash.i32(filter.origin().x);
  hash.i32(filter.origin().y);
  hash_floats(hash, filter.pose_covariances());
  if (!filter.landmark(slot).used()) return;
  hash_landmark(hash, filter.landmark(slot));
  hash_floats(hash, filter.place_covariances(slot));
  hash_floats(hash, filter.radius_covariances(slot));
}

}  // namespace fencepost::recon
