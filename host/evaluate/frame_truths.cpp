#include "host/evaluate/frame_truths.hpp"

namespace fencepost::host {
namespace {

bool same_box(const recon::Box& a, const recon::Box& b) {
  return a.x1 == b.x1 && a.y1 == b.y1 && a.x2 == b.x2 && a.y2 == b.y2;
}
bool same_blobs(const recon::WaitingFrame& a, const recon::WaitingFrame& b) {
  if (a.blobs.size() != b.blobs.size()) return false;
  for (std::size_t i = 0; i < a.blobs.size(); ++i) {
    if (a.blobs[i].signature != b.blobs[i].signature || !same_box(a.blobs[i].box, b.blobs[i].box)) return false;
  }
  return true;
}

bool lies_in(const sensor::Blob& blob, const recon::WaitingBlob& whole) {
  return blob.signature == whole.signature && blob.x1 >= whole.box.x1 && blob.x2 <= whole.box.x2 &&
         blob.y1 >= whole.box.y1 && blob.y2 <= whole.box.y2;
}

/// The blob itself or, where the robot joined several, the widest of them.
std::optional<std::size_t> owner(const FrameTruth& truth, const recon::WaitingBlob& blob) {
  std::optional<std::size_t> object;
  int widest = 0;
  for (std::size_t i = 0; i < truth.blobs.size(); ++i) {
    const sensor::Blob& part = truth.frame.blobs[i];
    const int width = part.x2 - part.x1 + 1;
    if (!lies_in(part, blob) || width <= widest) continue;
    widest = width;
    object = truth.blobs[i].object;
  }
  return object;
}

}  // namespace

FrameTruths::FrameTruths(const Scene& scene) {
  const auto summary = simulate_with_truth(
      scene, [](std::string_view) {}, [&](const FrameTruth& truth) { frames_.emplace(truth.frame.frame, truth); });
  if (!summary.ok()) frames_.clear();
}

std::optional<BlobOwners> FrameTruths::owners(const recon::WaitingFrame& frame) const {
  const auto truth = frames_.find(frame.frame);
  if (truth == frames_.end() || truth->second.frame.t != frame.t) return std::nullopt;
  if (!same_blobs(recon::make_waiting(truth->second.frame, frame.camera), frame)) return std::nullopt;
  BlobOwners owners;
  for (const recon::WaitingBlob& blob : frame.blobs) owners.push_back(owner(truth->second, blob));
  return owners;
}

}  // namespace fencepost::host
