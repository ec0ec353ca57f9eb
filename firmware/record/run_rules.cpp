#include "firmware/record/run_rules.hpp"

#include "firmware/record/layout.hpp"

namespace fencepost::record {

bool inside_image(const sensor::BlobFrame& frame, std::uint16_t width, std::uint16_t height) {
  for (const sensor::Blob& blob : frame.blobs) {
    if (blob.x1 < 0 || blob.y1 < 0 || blob.x2 >= width || blob.y2 >= height) return false;
  }
  return true;
}

bool inside_range(const sensor::OdometrySample& sample) {
  const auto within = [](std::int32_t raw, const NumberField& field) { return raw >= field.min && raw <= field.max; };
  return within(sample.x.raw, kPosition) && within(sample.y.raw, kPosition) && within(sample.heading.raw, kHeading);
}

std::optional<Reject> RunRules::admit(const Header& /*record*/) {
  *this = {};
  return std::nullopt;
}

std::optional<Reject> RunRules::admit(const sensor::CameraIntrinsics& record) {
  image_ = {record.width, record.height};
  return std::nullopt;
}

std::optional<Reject> RunRules::admit(const sensor::OdometrySample& record) { return admit_odometry(record.t); }
std::optional<Reject> RunRules::admit(const sensor::CarSample& record) { return admit_odometry(record.t); }

std::optional<Reject> RunRules::admit_odometry(base::Time t) {
  if (last_odometry_ && t <= *last_odometry_) return Reject::kTime;
  last_odometry_ = t;
  return std::nullopt;
}

std::optional<Reject> RunRules::admit(const sensor::BlobFrame& record) {
  if (image_ && !inside_image(record, image_->width, image_->height)) return Reject::kRange;
  if (last_frame_ && record.t <= *last_frame_) return Reject::kTime;
  last_frame_ = record.t;
  return std::nullopt;
}

}  // namespace fencepost::record
