// The true owner of each blob of a simulated log while the log is replayed. The scene is simulated beside it, a little
// ahead, so neither is ever in memory as a whole.
#pragma once

#include <memory>
#include <optional>

#include "host/evaluate/frame_truths.hpp"

namespace fencepost::host {

class SimulatedTruths {
 public:
  /// `scene` must outlive this. Nothing is known of a scene without a path.
  explicit SimulatedTruths(const Scene& scene);
  SimulatedTruths(const SimulatedTruths&) = delete;
  SimulatedTruths& operator=(const SimulatedTruths&) = delete;
  ~SimulatedTruths();

  /// The scene's run begins anew.
  void restart();
  /// As FrameTruths; frames have to be asked for in their order.
  std::optional<BlobOwners> owners(const recon::WaitingFrame& frame);

 private:
  class Ahead;

  const Scene& scene_;
  std::unique_ptr<Ahead> ahead_;  ///< from the first question on
};

}  // namespace fencepost::host
