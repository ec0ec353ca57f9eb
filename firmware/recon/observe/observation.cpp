#include "firmware/recon/observe/observation.hpp"

#include <cmath>

#include "firmware/recon/observe/occlusion.hpp"

namespace fencepost::recon {
namespace {

End end_of(bool hidden, bool near) {
  if (hidden) return End::kLowerBound;
  return near ? End::kAmbiguous : End::kSeen;
}

}  // namespace

std::int16_t whole_pixels(float value) {
  constexpr float kFarOutside = 30'000.0F;
  if (!(std::fabs(value) < kFarOutside)) return static_cast<std::int16_t>(value < 0 ? -kFarOutside : kFarOutside);
  return static_cast<std::int16_t>(value + std::copysign(0.5F, value));
}

Observation observe_alone(const CameraModel& camera, const Box& box, std::uint8_t signature) {
  const float v_middle = 0.5F * static_cast<float>(box.y1 + box.y2);
  const Sides cut = cut_by_border(camera, box);
  Observation observation;
  observation.box = box;
  observation.signature = signature;
  observation.left = end_of(cut.left, false);
  observation.right = end_of(cut.right, false);
  observation.top = end_of(cut.top, false);
  observation.bottom = end_of(cut.bottom, false);
  observation.left_column = whole_pixels(level_column(camera, left_edge(box), v_middle));
  observation.right_column = whole_pixels(level_column(camera, right_edge(box), v_middle));
  return observation;
}

void observe(std::span<const WaitingBlob> blobs, const CameraModel& camera, Observations& observations) {
  observations.clear();
  for (std::size_t b = 0; b < blobs.size(); ++b) {
    Observation observation = observe_alone(camera, blobs[b].box, blobs[b].signature);
    const Sides hidden = hidden_sides(blobs, b, camera.rows);
    const Sides beside = hidden_sides(blobs, b, camera.rows, kBesidePixels);
    const Sides border = near_border(blobs[b].box, camera.width);
    observation.left = end_of(!is_edge(observation.left) || hidden.left, beside.left || border.left);
    observation.right = end_of(!is_edge(observation.right) || hidden.right, beside.right || border.right);
    if (hidden.bottom) observation.bottom = End::kLowerBound;
    static_cast<void>(observations.push_back(observation));
  }
}

}  // namespace fencepost::recon
