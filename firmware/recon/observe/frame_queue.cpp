#include "firmware/recon/observe/frame_queue.hpp"

namespace fencepost::recon {
namespace {

bool comes_before(const WaitingBlob& a, const WaitingBlob& b) {
  if (a.signature != b.signature) return a.signature < b.signature;
  if (a.box.x1 != b.box.x1) return a.box.x1 < b.box.x1;
  if (a.box.y1 != b.box.y1) return a.box.y1 < b.box.y1;
  if (a.box.x2 != b.box.x2) return a.box.x2 < b.box.x2;
  if (a.box.y2 != b.box.y2) return a.box.y2 < b.box.y2;
  if (a.bearing != b.bearing) return a.bearing < b.bearing;
  return a.track < b.track;
}

}  // namespace

// Insertion sort: at most 16, usually in few runs.
void put_in_order(WaitingFrame& frame) {
  for (std::size_t i = 1; i < frame.blobs.size(); ++i) {
    const WaitingBlob blob = frame.blobs[i];
    std::size_t j = i;
    for (; j > 0 && comes_before(blob, frame.blobs[j - 1]); --j) frame.blobs[j] = frame.blobs[j - 1];
    frame.blobs[j] = blob;
  }
}

WaitingFrame make_waiting(const sensor::BlobFrame& frame, std::uint8_t camera) {
  WaitingFrame waiting;
  waiting.t = frame.t;
  waiting.frame = frame.frame;
  waiting.camera = camera;
  for (const sensor::Blob& blob : frame.blobs) {
    const Box box{blob.x1, blob.y1, blob.x2, blob.y2};
    WaitingBlob kept{box, blob.signature, false, blob.bearing};
    if (blob.track != 0) kept.track = (1 + (blob.track - 1) % kMaxTrack) & kMaxTrack;
    static_cast<void>(waiting.blobs.push_back(kept));
  }
  put_in_order(waiting);
  return waiting;
}

}  // namespace fencepost::recon
