// The rules that a record has to obey, given the records before it in the same run.
#pragma once

#include <cstdint>
#include <optional>

#include "firmware/record/records.hpp"

namespace fencepost::record {

/// All boxes lie within an image of that size.
[[nodiscard]] bool inside_image(const sensor::BlobFrame& frame, std::uint16_t width, std::uint16_t height);

/// Position and heading lie within the stream's range: what is outside has no record.
[[nodiscard]] bool inside_range(const sensor::OdometrySample& sample);

/// Each `admit` takes a record into account, or returns why it must not be used and then changes nothing.
class RunRules {
 public:
  /// Starts a run: forgets times and camera.
  std::optional<Reject> admit(const Header& record);
  /// The size in force for the frames after it.
  std::optional<Reject> admit(const sensor::CameraIntrinsics& record);
  /// errors: time (t not after the last FPODO's or FPCAR's)
  std::optional<Reject> admit(const sensor::OdometrySample& record);
  /// The same, of either of the two.
  std::optional<Reject> admit(const sensor::CarSample& record);
  /// errors: range (a box leaves the image; unchecked before any FPCAM), time (t not after the last FPFRM's)
  std::optional<Reject> admit(const sensor::BlobFrame& record);
  template <class Record>
  std::optional<Reject> admit(const Record&) {
    return std::nullopt;
  }

 private:
  std::optional<Reject> admit_odometry(base::Time t);

  struct ImageSize {
    std::uint16_t width = 0;
    std::uint16_t height = 0;
  };
  std::optional<ImageSize> image_;
  std::optional<base::Time> last_odometry_;
  std::optional<base::Time> last_frame_;
};

}  // namespace fencepost::record
