// Between the numbers of the library's header and those of the loop.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "firmware/fencepost/fencepost.hpp"
#include "firmware/record/records.hpp"
#include "hal/base/result.hpp"

namespace fencepost::library {

inline constexpr std::int64_t kMicrosPerTick = 100;

/// The tick in which a microsecond lies; also before zero.
constexpr base::Time time_of(std::int64_t micros) {
  const std::int64_t ticks = micros / kMicrosPerTick;
  return {ticks - (ticks * kMicrosPerTick > micros ? 1 : 0)};
}
constexpr std::int64_t micros_of(base::Time time) { return time.raw * kMicrosPerTick; }

/// errors: kRange: what the stream cannot express
base::Result<sensor::CameraIntrinsics, Answer> intrinsics_of(const fencepost_camera& camera);
base::Result<record::Signature, Answer> signature_of(const fencepost_colour& colour);
base::Result<sensor::OdometrySample, Answer> sample_of(base::Time t, const Pose& pose);

/// True if the last pixel of each box is not before the first.
bool are_boxes(std::span<const fencepost_box> boxes);
/// The largest first.
sensor::BlobFrame frame_of(base::Time t, std::uint32_t number, std::span<const fencepost_box> boxes);

/// As the console takes it. errors: kUnknown, kRange
base::Result<sensor::Text, Answer> setting_of(std::string_view key, float value);

Alert alert_of(const record::AlertReport& report, const char* sentence);
Object object_of(const record::ObjectReport& report);
Way way_of(const record::WayReport::Way& way);

}  // namespace fencepost::library
