#include "firmware/recon/digest.hpp"

#include "firmware/recon/models/hash.hpp"

namespace fencepost::recon {

void hash_pose(base::Fnv1a64& hash, const MapPose& pose) {
  hash.i32(pose.position.x);
  hash.i32(pose.position.y);
  hash.i32(pose.heading);
}

void hash_sighted(base::Fnv1a64& hash, const ObjectCore& object) {
  const CylinderEstimate& estimate = object.cylinder.estimate();
  hash.u32(object.id);
  hash.u32(object.views);
  hash.u8(static_cast<std::uint8_t>(estimate.refusal));
  if (!estimate.ok()) return;
  hash_vec(hash, estimate.center);
  hash.f32(estimate.radius);
}

void hash_floats(base::Fnv1a64& hash, std::span<const float> values) {
  for (const float value : values) hash.f32(value);
}

void hash_landmark(base::Fnv1a64& hash, const Landmark& landmark) {
  hash.i32(landmark.center.x);
  hash.i32(landmark.center.y);
  hash.f32(landmark.radius);
}

}  // namespace fencepost::recon
