#include "tests/studies/hazards/peer_rules.hpp"

#include "tests/studies/alerts/ground_truth.hpp"

namespace fencepost::test {

bool stops_by_range(const sensor::CameraIntrinsics& camera, const sensor::Blob& block) {
  const int rows = block.y2 - block.y1 + 1;
  return kPeerBlock * camera.fy.to_double() / rows <= AlertLimits{}.stop;
}

bool stops_by_width(const sensor::CameraIntrinsics& camera, const sensor::Blob& block) {
  const int columns = block.x2 - block.x1 + 1;
  return columns >= kPeerBlock * camera.fx.to_double() / AlertLimits{}.stop;
}

void PeerRule::accept(const sensor::BlobFrame& frame) {
  const bool stop = !frame.blobs.empty() && stops_(camera_, frame.blobs[0]);
  if (stop == says_stop()) return;
  record::AlertReport alert;
  alert.t = frame.t;
  alert.level = stop ? record::AlertLevel::kStop : record::AlertLevel::kClear;
  say(alert);
}

}  // namespace fencepost::test
