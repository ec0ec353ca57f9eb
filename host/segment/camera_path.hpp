// Where a camera was for each image, as COLMAP and the tools around TUM's benchmark write it.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace fencepost::host {

/// The camera's axes are those of its image: x right, y down, z into the picture.
struct CameraStand {
  std::size_t line = 0;  ///< 1-based, for messages
  std::string image;     ///< of COLMAP; TUM's have none
  double t = 0;          ///< s, of TUM; COLMAP's have none
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Matrix3d world_r_camera = Eigen::Matrix3d::Identity();
};

enum class PathFormat : unsigned char {
  kTable,   ///< CSV with names of columns: poses_table.hpp
  kTum,     ///< timestamp tx ty tz qx qy qz qw: the pose in the world
  kColmap,  ///< images.txt: IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME, then a line of points; the world in the
            ///< camera
};
PathFormat path_format(std::string_view text);

/// In order of their names, as pictures of a drive are numbered. errors: SegmentProblem with file and line
std::vector<CameraStand> parse_colmap_images(std::string_view text, const std::string& file);

/// s. A time beyond 1e12 is in nanoseconds, as EuRoC's are: no clock in seconds reaches it.
inline double seconds_of(double time) { return time > 1e12 ? 1e-9 * time : time; }

/// Times strictly increasing, read by seconds_of(). errors: SegmentProblem with file and
/// line
std::vector<CameraStand> parse_tum(std::string_view text, const std::string& file);

}  // namespace fencepost::host
