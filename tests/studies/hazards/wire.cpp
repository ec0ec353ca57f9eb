#include "tests/studies/hazards/wire.hpp"

#include "tests/firmware/record/lines.hpp"

namespace fencepost::test {

std::string_view Wire::carry(std::string_view line) {
  if (outage_.fault == Fault::kNone) return line;
  line_ = line;
  reader_.push(line, *this);
  return line_;
}

void Wire::accept(const sensor::OdometrySample& sample) {
  if (outage_.fault == Fault::kOdometrySilent && out(sample.t)) line_.clear();
}

void Wire::accept(const sensor::BlobFrame& frame) {
  if (!out(frame.t)) {
    last_ = frame;
    return;
  }
  sensor::BlobFrame arrives = frame;
  switch (outage_.fault) {
    case Fault::kCameraSilent: line_.clear(); return;
    case Fault::kCameraFrozen: arrives.blobs = last_.blobs; break;
    case Fault::kCameraNonsense:
      for (sensor::Blob& blob : arrives.blobs) {
        blob.x1 = static_cast<std::int16_t>(blob.x1 + 2 * width_);
        blob.x2 = static_cast<std::int16_t>(blob.x2 + 2 * width_);
      }
      break;
    default: return;
  }
  line_ = line_of(arrives);
}

}  // namespace fencepost::test
