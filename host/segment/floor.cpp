#include "host/segment/floor.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "host/segment/problem.hpp"

namespace fencepost::host {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kMinSpread = 0.05;      // rad: less turning than that is noise
constexpr double kStoodStill = 1e-6;     // of the distance from the origin: rounding
constexpr double kMaxRoll = 0.1;         // rad, rms
constexpr double kUprightWorld = 0.985;  // cos 10 deg

/// The axes of the image once it is turned clockwise.
Matrix3d turned(const Matrix3d& world_r_camera, int clockwise) {
  const Vector3d x = world_r_camera.col(0);
  const Vector3d y = world_r_camera.col(1);
  Matrix3d axes = world_r_camera;
  if (clockwise == 90) axes << -y, x, world_r_camera.col(2);
  if (clockwise == 180) axes << -x, -y, world_r_camera.col(2);
  if (clockwise == 270) axes << y, -x, world_r_camera.col(2);
  return axes;
}

/// Sum of the outer products of directions in the floor's plane: rows of images, and the way as a share of its length.
Matrix3d spread(const std::vector<Matrix3d>& axes, const std::vector<CameraStand>& stands) {
  Vector3d middle = Vector3d::Zero();
  for (const CameraStand& stand : stands) middle += stand.position / static_cast<double>(stands.size());
  double farthest = 0;
  for (const CameraStand& stand : stands) farthest = std::max(farthest, (stand.position - middle).norm());
  Matrix3d sum = Matrix3d::Zero();
  for (std::size_t i = 0; i < stands.size(); ++i) {
    const Vector3d row = axes[i].col(0);
    sum += row * row.transpose();
    if (farthest <= kStoodStill * (1 + middle.norm())) continue;
    const Vector3d way = (stands[i].position - middle) / farthest;
    sum += way * way.transpose();
  }
  return sum / static_cast<double>(stands.size());
}

Vector3d up_of(const std::vector<Matrix3d>& axes, const std::vector<CameraStand>& stands,
               const sensor::CameraMount& mount, const std::string& file) {
  Vector3d top = Vector3d::Zero();  // of the images, all together
  for (const Matrix3d& camera : axes) top -= camera.col(1);
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(spread(axes, stands));
  if (solver.eigenvalues()[1] > kMinSpread * kMinSpread) {
    const Vector3d up = solver.eigenvectors().col(0);
    return up.dot(top) < 0 ? Vector3d(-up) : up;
  }
  if (!mount.pitch) {
    throw SegmentProblem{file, "has a camera that never turned nor left its place: which way is up is not known",
                         "give the calibration its pitch"};
  }
  const double pitch = mount.pitch->to_double();
  Vector3d up = Vector3d::Zero();
  for (const Matrix3d& camera : axes) up -= std::cos(pitch) * camera.col(1) + std::sin(pitch) * camera.col(2);
  return up.normalized();
}

/// The robot's place and heading, from the camera's on the floor.
TimedPose robot_of(double t, double x, double y, double camera_heading, const sensor::CameraMount& mount) {
  const double heading = camera_heading - mount.yaw.to_double();
  const double c = std::cos(heading);
  const double s = std::sin(heading);
  const double ahead = mount.x.to_double();
  const double left = mount.y.to_double();
  return {t, x - c * ahead + s * left, y - s * ahead - c * left, std::remainder(heading, 2 * M_PI)};
}

OnFloor robots(const std::vector<CameraStand>& stands, const FloorOptions& options, const std::string& file) {
  OnFloor floor;
  for (const CameraStand& stand : stands) {
    const Matrix3d& r = stand.world_r_camera;
    if (r(2, 2) < kUprightWorld) {
      throw SegmentProblem{file + ":" + std::to_string(stand.line), "is a pose whose z axis does not point up",
                           "it may be the camera's: leave out --poses-of robot"};
    }
    floor.poses.push_back({stand.t, options.scale * stand.position.x(), options.scale * stand.position.y(),
                           std::atan2(r(1, 0), r(0, 0))});
  }
  return floor;
}

}  // namespace

OnFloor onto_floor(const std::vector<CameraStand>& stands, const sensor::CameraMount& mount,
                   const FloorOptions& options, const std::string& file) {
  if (stands.empty()) throw SegmentProblem{file, "has no poses", "check that the copy is complete"};
  if (options.of_robot) return robots(stands, options, file);
  std::vector<Matrix3d> axes;
  for (const CameraStand& stand : stands) axes.push_back(turned(stand.world_r_camera, options.rotate));
  const Vector3d up = up_of(axes, stands, mount, file);
  OnFloor floor;
  for (const Matrix3d& camera : axes) {
    floor.roll += std::pow(camera.col(0).dot(up), 2) / static_cast<double>(axes.size());
    floor.pitch += std::asin(std::clamp(-camera.col(2).dot(up), -1.0, 1.0)) / static_cast<double>(axes.size());
  }
  floor.roll = std::sqrt(floor.roll);
  if (floor.roll > kMaxRoll) {
    throw SegmentProblem{file, "has a camera that does not ride upright: its rows lie in no plane",
                         "turn the images with --rotate; for poses of the robot, z up, say --poses-of robot"};
  }
  const bool upright = up.z() > kUprightWorld;
  const Vector3d origin = upright ? Vector3d::Zero() : Vector3d(stands.front().position);
  const Vector3d along = upright ? Vector3d::UnitX() : Vector3d(axes.front().col(2));
  const Vector3d ahead = (along - along.dot(up) * up).normalized();
  const Vector3d left = up.cross(ahead);
  for (std::size_t i = 0; i < stands.size(); ++i) {
    const Vector3d at = options.scale * (stands[i].position - origin);
    const Vector3d view = axes[i].col(2);
    floor.poses.push_back(
        robot_of(stands[i].t, at.dot(ahead), at.dot(left), std::atan2(view.dot(left), view.dot(ahead)), mount));
  }
  return floor;
}

}  // namespace fencepost::host
