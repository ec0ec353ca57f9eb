// The true owner of each blob of a simulated log, found by simulating the scene again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "firmware/recon/observe/frame_queue.hpp"
#include "host/scene/scene.hpp"
#include "host/simulate/truth.hpp"

namespace fencepost::host {

/// For each blob of a frame the index of its true object; empty: a false blob, or one of several objects.
using BlobOwners = std::vector<std::optional<std::size_t>>;

/// Owners of the blobs in their order; nothing if it is not that frame. Of two blobs that the robot joined, the wider
/// one counts.
std::optional<BlobOwners> owners_in(const FrameTruth& truth, const recon::WaitingFrame& frame);

/// Takes off the boxes of a scene's frame what the robot takes off, by the scene's signatures.
void take_off_pads(const Scene& scene, FrameTruth& truth);

class FrameTruths {
 public:
  /// Simulates the scene; empty if it has no path or cannot be simulated.
  explicit FrameTruths(const Scene& scene);
  /// From given frames.
  explicit FrameTruths(std::span<const FrameTruth> frames);

  /// As owners_in; nothing for a frame that this scene does not give.
  [[nodiscard]] std::optional<BlobOwners> owners(const recon::WaitingFrame& frame) const;

 private:
  std::unordered_map<std::uint32_t, FrameTruth> frames_;
};

}  // namespace fencepost::host
