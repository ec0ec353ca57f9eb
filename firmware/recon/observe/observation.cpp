#include "firmware/recon/observe/observation.hpp"

#include "firmware/recon/observe/occlusion.hpp"

namespace fencepost::recon {
namespace {

End end_of(bool hidden, bool near) {
  if (hidden) return End::kLowerBound;
  return near ? End::kAmbiguous : End::kSeen;
}

}  // namespace

Observation observe_alone(const CameraModel& camera, const Box& box, std::uint8_t signature) {
  const PixelRow middle(camera, 0.5F * static_cast<float>(box.y1 + box.y2));
  const Sides cut = cut_by_border(camera, box);
  Observation observation;
  observation.box = box;
  observation.signature = signature;
  observation.left = end_of(cut.left, false);
  observation.right = end_of(cut.right, false);
  observation.top = end_of(cut.top, false);
  observation.bottom = end_of(cut.bottom, false);
  observation.left_column = middle.level_column(left_edge(box));
  observation.right_column = middle.level_column(right_edge(box));
  return observation;
}

Observation observe_bearing(const CameraModel& camera, const Box& box, std::uint8_t signature) {
  Observation observation = observe_alone(camera, box, signature);
  observation.bearing = true;
  observation.left = observation.right = observation.top = observation.bottom = End::kOccluded;
  return observation;
}

void observe(std::span<const WaitingBlob> blobs, const CameraModel& camera, Observations& observations) {
  observations.clear();
  for (std::size_t b = 0; b < blobs.size(); ++b) {
    if (blobs[b].bearing) {
      Observation bearing = observe_bearing(camera, blobs[b].box, blobs[b].signature);
      bearing.track = blobs[b].track;
      static_cast<void>(observations.push_back(bearing));
      continue;
    }
    Observation observation = observe_alone(camera, blobs[b].box, blobs[b].signature);
    observation.track = blobs[b].track;
    const Sides hidden = hidden_sides(blobs, b, camera.rows);
    const Sides beside = hidden_sides(blobs, b, camera.rows, kBesidePixels);
    const Sides border = near_border(blobs[b].box, camera.width);
    observation.left = end_of(!is_edge(observation.left) || hidden.left, beside.left || border.left);
    observation.right = end_of(!is_edge(observation.right) || hidden.right, beside.right || border.right);
    observation.moves = blobs[b].moves;
    if (hidden.bottom) observation.bottom = End::kLowerBound;
    static_cast<void>(observations.push_back(observation));
  }
}

}  // namespace fencepost::recon
