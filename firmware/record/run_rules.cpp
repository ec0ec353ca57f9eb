#include "firmware/record/run_rules.hpp"

namespace fencepost::record {

std::optional<Reject> RunRules::admit(const Header& /*record*/) {
  *this = {};
  return std::nullopt;
}

std::optional<Reject> RunRules::admit(const sensor::CameraIntrinsics& record) {
  image_ = {record.width, record.height};
  return std::nullopt;
}

std::optional<Reject> RunRules::admit(const sensor::OdometrySample& record) {
  if (last_odometry_ && record.t <= *last_odometry_) return Reject::kTime;
  last_odometry_ = record.t;
  return std::nullopt;
}

std::optional<Reject> RunRules::admit(const sensor::BlobFrame& record) {
  if (image_) {
    for (const sensor::Blob& blob : record.blobs) {
      const bool inside = blob.x1 >= 0 && blob.y1 >= 0 && blob.x2 < image_->width && blob.y2 < image_->height;
      if (!inside) return Reject::kRange;
    }
  }
  if (last_frame_ && record.t <= *last_frame_) return Reject::kTime;
  last_frame_ = record.t;
  return std::nullopt;
}

}  // namespace fencepost::record
