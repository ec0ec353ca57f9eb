// Puts imported samples and frames into one record stream, in an order that any reader can follow.
#pragma once

#include <string>
#include <vector>

#include "firmware/record/records.hpp"
#include "host/import/import.hpp"

namespace fencepost::host {

/// Incremented whenever the same source gives different bytes. Written as the version of FPHDR.
inline constexpr std::string_view kImporterVersion = "0.1.0";

struct LogParts {
  std::string target;  ///< FPHDR's target: where the data are from
  sensor::CameraIntrinsics camera;
  std::vector<record::Signature> signatures;
  std::vector<record::Setting> settings;
  std::vector<sensor::OdometrySample> odometry;  ///< times strictly increasing
  std::vector<sensor::CarSample> car;            ///< in place of odometry, times strictly increasing
  std::vector<sensor::BlobFrame> frames;         ///< times strictly increasing
};

/// Header, calibration (again every 10 s), then odometry by time. Each frame follows the first sample at or past its
/// exposure, so no reader has to wait for its pose.
/// error: ImportProblem when a value is outside the range of its record.
std::string build_log(const LogParts& parts);

/// A box from the left edge of column `left` to the right edge, both continuous pixel coordinates, clamped to the
/// image. It has the image's whole height (no ground row). False when nothing of it is inside.
bool make_box(const sensor::CameraIntrinsics& camera, double left, double right, sensor::Blob& blob);

/// `index` of `count` colours evenly spaced in hue.
sensor::Rgb colour_number(std::size_t index, std::size_t count);

}  // namespace fencepost::host
