#include "drivers/serial/largest_first.hpp"

#include <utility>

namespace fencepost::serial {
namespace {

std::uint32_t size_of(const sensor::Blob& blob) {
  if (blob.pixels != 0) return blob.pixels;
  return static_cast<std::uint32_t>((blob.x2 - blob.x1 + 1) * (blob.y2 - blob.y1 + 1));
}

}  // namespace

bool insert_largest_first(sensor::BlobFrame& frame, const sensor::Blob& blob) {
  bool all_kept = true;
  if (frame.blobs.full()) {
    all_kept = false;
    if (size_of(frame.blobs[frame.blobs.size() - 1]) >= size_of(blob)) return false;
    frame.blobs.pop_back();
  }
  (void)frame.blobs.push_back(blob);
  for (std::size_t i = frame.blobs.size() - 1; i > 0; --i) {
    if (size_of(frame.blobs[i - 1]) >= size_of(frame.blobs[i])) break;
    std::swap(frame.blobs[i - 1], frame.blobs[i]);
  }
  return all_kept;
}

}  // namespace fencepost::serial
