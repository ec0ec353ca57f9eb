#include "host/evaluate/frame_truths.hpp"

#include <algorithm>
#include <utility>

namespace fencepost::host {
namespace {

bool lies_in(const sensor::Blob& blob, const recon::WaitingBlob& whole) {
  return blob.signature == whole.signature && blob.x1 >= whole.box.x1 && blob.x2 <= whole.box.x2 &&
         blob.y1 >= whole.box.y1 && blob.y2 <= whole.box.y2;
}

/// A blob of the map's frame is the box around the camera's blobs inside it: one, or the pieces that were joined.
bool is_box_around_its_parts(const recon::WaitingBlob& whole, const sensor::BlobFrame& parts) {
  std::optional<recon::Box> around;
  for (const sensor::Blob& part : parts.blobs) {
    if (!lies_in(part, whole)) continue;
    if (!around) around = {part.x1, part.y1, part.x2, part.y2};
    around = {std::min(around->x1, part.x1), std::min(around->y1, part.y1), std::max(around->x2, part.x2),
              std::max(around->y2, part.y2)};
  }
  return around && around->x1 == whole.box.x1 && around->y1 == whole.box.y1 && around->x2 == whole.box.x2 &&
         around->y2 == whole.box.y2;
}

bool same_frame(const sensor::BlobFrame& logged, const recon::WaitingFrame& placed) {
  const auto& blobs = placed.blobs;
  return logged.t == placed.t &&
         std::all_of(blobs.begin(), blobs.end(),
                     [&](const recon::WaitingBlob& blob) { return is_box_around_its_parts(blob, logged); }) &&
         std::all_of(logged.blobs.begin(), logged.blobs.end(), [&](const sensor::Blob& part) {
           return std::any_of(blobs.begin(), blobs.end(),
                              [&](const recon::WaitingBlob& blob) { return lies_in(part, blob); });
         });
}

/// The blob's owner or, where the robot joined several, that of the widest of them. A blob of several objects has none.
std::optional<std::size_t> owner(const FrameTruth& truth, const recon::WaitingBlob& blob) {
  std::optional<std::size_t> object;
  int widest = 0;
  for (std::size_t i = 0; i < truth.blobs.size(); ++i) {
    const sensor::Blob& part = truth.frame.blobs[i];
    const int width = part.x2 - part.x1 + 1;
    if (!lies_in(part, blob) || width <= widest) continue;
    widest = width;
    object = truth.blobs[i].others.empty() ? truth.blobs[i].object : std::nullopt;
  }
  return object;
}

}  // namespace

std::optional<BlobOwners> owners_in(const FrameTruth& truth, const recon::WaitingFrame& frame) {
  if (!same_frame(truth.frame, frame)) return std::nullopt;
  BlobOwners owners;
  for (const recon::WaitingBlob& blob : frame.blobs) owners.push_back(owner(truth, blob));
  return owners;
}

void take_off_pads(const Scene& scene, FrameTruth& truth) {
  const recon::CameraModel camera = recon::make_camera_model(scene.camera);
  for (sensor::Blob& blob : truth.frame.blobs) {
    const auto known = std::ranges::find(scene.signatures, blob.signature, &SceneSignature::id);
    if (known == scene.signatures.end() || known->pad == 0) continue;
    const recon::Box bare = recon::without_pad(camera, {blob.x1, blob.y1, blob.x2, blob.y2}, known->pad);
    blob.x1 = bare.x1;
    blob.y1 = bare.y1;
    blob.x2 = bare.x2;
    blob.y2 = bare.y2;
  }
}

FrameTruths::FrameTruths(const Scene& scene) {
  const auto keep = [&](FrameTruth truth) {
    take_off_pads(scene, truth);
    frames_.emplace(truth.frame.frame, std::move(truth));
  };
  const auto summary = simulate_with_truth(
      scene, [](std::string_view) {}, keep);
  if (!summary.ok()) frames_.clear();
}

FrameTruths::FrameTruths(std::span<const FrameTruth> frames) {
  for (const FrameTruth& truth : frames) frames_.emplace(truth.frame.frame, truth);
}

std::optional<BlobOwners> FrameTruths::owners(const recon::WaitingFrame& frame) const {
  const auto truth = frames_.find(frame.frame);
  if (truth == frames_.end()) return std::nullopt;
  return owners_in(truth->second, frame);
}

}  // namespace fencepost::host
