// A camera for importers of blobs and poses, and the log that came of them.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "host/import/take.hpp"
#include "tests/host/import/files.hpp"

namespace fencepost::host {

inline TakeSettings settings(int width = 316, int height = 208, int focal = 270) {
  TakeSettings settings;
  sensor::CameraIntrinsics camera;
  camera.model = "test";
  camera.width = static_cast<std::uint16_t>(width);
  camera.height = static_cast<std::uint16_t>(height);
  camera.fx = camera.fy = base::Pixels2::nearest(focal);
  camera.cx = base::Pixels2::nearest((width - 1) / 2.0);
  camera.cy = base::Pixels2::nearest((height - 1) / 2.0);
  settings.camera = camera;
  return settings;
}

inline std::uint64_t skipped(const ImportResult& result, const std::string& what) {
  for (const auto& [name, count] : result->summary.skipped) {
    if (name == what) return count;
  }
  return 0;
}

inline void expect_box(const sensor::Blob& blob, int signature, int x1, int y1, int x2, int y2) {
  EXPECT_EQ(blob.signature, signature);
  expect_box(blob, x1, y1, x2, y2);
}

}  // namespace fencepost::host
