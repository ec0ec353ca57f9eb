// The files of one drive of KITTI's tracking data set, read and checked. Lengths are those of the world, m.
#pragma once

#include <string>
#include <vector>

#include "host/geometry/polygon.hpp"
#include "host/scene/scene.hpp"

namespace fencepost::host {

/// Inclusive pixels of the left colour camera's image.
struct KittiBox {
  double x1 = 0;
  double y1 = 0;
  double x2 = 0;
  double y2 = 0;
};

/// One labelled thing in one frame. Place: of the middle of its bottom, in the camera's frame: x right, z ahead.
struct KittiLabel {
  int track = 0;
  std::string kind;  ///< Car, Van, Pedestrian, ...; DontCare is left out
  int occluded = 0;  ///< 0 visible, 1 partly, 2 largely hidden, 3 unknown
  KittiBox box;
  double height = 0;
  double width = 0;
  double length = 0;
  double x = 0;
  double z = 0;
  double yaw = 0;  ///< rad, about the vertical axis; 0 points right

  [[nodiscard]] bool is_car() const { return kind == "Car" || kind == "Van" || kind == "Truck"; }
  /// Not largely hidden: the box of a car that is, is a guess.
  [[nodiscard]] bool is_shown() const { return occluded <= 1; }
  /// Of its track in logs and scenes.
  [[nodiscard]] std::string name() const { return kind + " " + std::to_string(track); }
};

struct KittiFrame {
  TimedPose pose;  ///< of the camera in the plane: x ahead at the start, y left
  std::vector<KittiLabel> labels;

  /// World place of a point `right` and `ahead` of the camera, m.
  [[nodiscard]] Point place(double right, double ahead) const;
};

struct KittiDrive {
  double focal = 0;  ///< px
  double cx = 0;
  double cy = 0;
  int width = 0;  ///< px, of the image
  int height = 0;
  std::vector<KittiFrame> frames;  ///< 10 a second, one for each pose
  std::size_t frames_without_pose = 0;
};

inline constexpr double kKittiRate = 10;  ///< frames/s

/// A folder with labels.txt, calib.txt and poses.txt. error: ImportProblem, naming file and line
KittiDrive read_kitti(const std::string& folder);

/// Lines "frame, x1, y1, x2, y2, score" of a detector; one list for each of `frames`. error: ImportProblem
std::vector<std::vector<KittiBox>> read_detections(const std::string& path, std::size_t frames);

}  // namespace fencepost::host
