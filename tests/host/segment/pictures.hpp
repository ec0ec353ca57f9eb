// Small images with known content, and a folder to put them in.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "host/segment/segment.hpp"
#include "tests/folder.hpp"
#include "tests/host/simulate/recorded.hpp"

namespace fencepost::host {

inline const sensor::Rgb kRed{200, 30, 30};
inline const sensor::Rgb kShadedRed{90, 12, 12};  ///< the same paint in less light
inline const sensor::Rgb kYellow{215, 180, 20};
inline const sensor::Rgb kBlue{30, 60, 170};
inline const sensor::Rgb kGreen{25, 130, 60};
inline const sensor::Rgb kGrey{128, 128, 128};
inline const sensor::Rgb kWall{190, 188, 180};
inline const sensor::Rgb kWood{200, 184, 163};

inline cv::Vec3b bgr(sensor::Rgb rgb) { return {rgb.blue, rgb.green, rgb.red}; }

inline cv::Mat canvas(int width, int height, sensor::Rgb rgb) {
  cv::Mat image(height, width, CV_8UC3);
  image.setTo(cv::Scalar(rgb.blue, rgb.green, rgb.red));
  return image;
}

/// Bounds inclusive.
inline void paint(cv::Mat& image, int x1, int y1, int x2, int y2, sensor::Rgb rgb) {
  for (int v = y1; v <= y2; ++v) {
    for (int u = x1; u <= x2; ++u) image.at<cv::Vec3b>(v, u) = bgr(rgb);
  }
}

/// Wall above, wood below, as seen by a level camera.
inline cv::Mat room(int width = 160, int height = 120) {
  cv::Mat image = canvas(width, height, kWall);
  paint(image, 0, height / 2, width - 1, height - 1, kWood);
  return image;
}

inline sensor::CameraIntrinsics camera_of(int width, int height) {
  sensor::CameraIntrinsics camera;
  camera.model = "test";
  camera.width = static_cast<std::uint16_t>(width);
  camera.height = static_cast<std::uint16_t>(height);
  camera.fx = base::Pixels2::nearest(150);
  camera.fy = camera.fx;
  camera.cx = base::Pixels2::nearest((width - 1) / 2.0);
  camera.cy = base::Pixels2::nearest((height - 1) / 2.0);
  camera.mount.z = base::Metres::nearest(0.1);
  camera.mount.pitch = base::Radians{0};
  return camera;
}

/// Images in a folder that lives as long as a test, taken 0.1 s and 1 cm apart.
class Pictures {
 public:
  void add(const cv::Mat& image) {
    const auto i = static_cast<double>(views_.size());
    const std::string path = folder_.file("view" + std::to_string(views_.size()) + ".png");
    test::spill(path, encode_png(image));
    views_.push_back({path, {0.1 * i, 0.01 * i, 0, 0}});
  }
  [[nodiscard]] const std::vector<View>& views() const { return views_; }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_.path(); }

 private:
  test::Folder folder_;
  std::vector<View> views_;
};

/// Segments images of one size and reads the log back.
inline Recorded segmented(const std::vector<cv::Mat>& images, const SegmentOptions& options = {},
                          SegmentSummary* summary = nullptr) {
  Pictures pictures;
  for (const cv::Mat& image : images) pictures.add(image);
  const SegmentResult result = segment(pictures.views(), camera_of(images[0].cols, images[0].rows), options);
  if (!result.ok()) {
    ADD_FAILURE() << result.error().message();
    return {};
  }
  if (summary != nullptr) *summary = result->summary;
  return read_back(result->log);
}

/// Blobs of the signature with that name in frame `i`, in the frame's order.
inline std::vector<sensor::Blob> blobs_named(const Recorded& log, const std::string& name, std::size_t i = 0) {
  std::vector<sensor::Blob> blobs;
  for (const record::Signature& signature : log.signatures) {
    if (signature.name.view() != name) continue;
    for (const sensor::Blob& blob : log.frames.at(i).blobs) {
      if (blob.signature == signature.signature) blobs.push_back(blob);
    }
  }
  return blobs;
}

inline record::Signature given(std::uint8_t number, const char* name, sensor::Rgb rgb) {
  return {number, rgb, sensor::Text(name)};
}

}  // namespace fencepost::host
