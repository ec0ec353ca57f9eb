#include "host/segment/pinhole.hpp"

#include <algorithm>
#include <cmath>

#include "host/segment/problem.hpp"

namespace fencepost::host {
namespace {

constexpr double kMaxPixels = 2;
constexpr double kLargest = 32'767;

/// The shift of the farthest corner by the coefficients beyond k1, px.
double beyond_k1(const Pinhole& p) {
  const auto& [k1, k2, p1, p2, k3] = p.distortion;
  const double x = std::max(p.cx, p.width - p.cx) / p.fx;
  const double y = std::max(p.cy, p.height - p.cy) / p.fy;
  const double r2 = x * x + y * y;
  const double radial = std::sqrt(r2) * (std::abs(k2) * r2 * r2 + std::abs(k3) * r2 * r2 * r2);
  const double tangential = (std::abs(p1) + std::abs(p2)) * 3 * r2;
  return p.fx * (radial + tangential);
}

}  // namespace

sensor::CameraIntrinsics to_camera(const Pinhole& pinhole, const char* model, const std::string& name,
                                   const char* remedy) {
  const auto side = [](double pixels) { return pixels >= 2 && pixels <= kLargest; };
  const auto focal = [](double pixels) { return pixels > 0 && pixels < kLargest; };
  if (!side(pinhole.width) || !side(pinhole.height) || !focal(pinhole.fx) || !focal(pinhole.fy) ||
      std::abs(pinhole.cx) > kLargest || std::abs(pinhole.cy) > kLargest || std::abs(pinhole.distortion[0]) > 100) {
    throw SegmentProblem{name, "has numbers that no camera has", "check that the copy is complete"};
  }
  if (beyond_k1(pinhole) > kMaxPixels) {
    throw SegmentProblem{name, "has coefficients beyond k1 that move the image's corners by more than 2 px", remedy};
  }
  sensor::CameraIntrinsics camera;
  camera.model = model;
  camera.width = static_cast<std::uint16_t>(pinhole.width);
  camera.height = static_cast<std::uint16_t>(pinhole.height);
  camera.fx = base::Pixels2::nearest(pinhole.fx);
  camera.fy = base::Pixels2::nearest(pinhole.fy);
  camera.cx = base::Pixels2::nearest(pinhole.cx);
  camera.cy = base::Pixels2::nearest(pinhole.cy);
  camera.k1 = base::Ratio4::nearest(pinhole.distortion[0]);
  return camera;
}

}  // namespace fencepost::host
