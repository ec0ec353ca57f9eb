#include "drivers/wire/largest_first.hpp"

namespace fencepost::wire {
namespace {

std::int32_t area(const sensor::Blob& blob) { return (blob.x2 - blob.x1 + 1) * (blob.y2 - blob.y1 + 1); }

}  // namespace

bool insert_largest_first(Blobs& blobs, const sensor::Blob& blob) {
  std::size_t at = blobs.size();
  while (at > 0 && area(blobs[at - 1]) < area(blob)) --at;
  const bool full = blobs.full();
  if (full && at == blobs.size()) return true;
  if (full) blobs.pop_back();
  if (!blobs.push_back(blob)) return true;
  for (std::size_t i = blobs.size() - 1; i > at; --i) blobs[i] = blobs[i - 1];
  blobs[at] = blob;
  return full;
}

}  // namespace fencepost::wire
