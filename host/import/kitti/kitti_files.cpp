#include "host/import/kitti/kitti_files.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "host/import/table.hpp"

namespace fencepost::host {
namespace {

constexpr std::size_t kLabelWords = 17;
constexpr const char* kLabelNames =
    "frame track kind truncated occluded alpha x1 y1 x2 y2 height width length x y z yaw";

/// The recording days differ in rectification. px; source: the images of the raw data's five days.
struct Rectified {
  double focal;
  int width;
  int height;
};
constexpr std::array<Rectified, 5> kDays = {
    {{721.5377, 1242, 375}, {718.856, 1241, 376}, {718.3351, 1238, 374}, {707.0912, 1226, 370}, {707.0493, 1224, 370}}};

std::string in(const std::string& folder, const char* name) { return (std::filesystem::path(folder) / name).string(); }

/// Returns how far the colour camera is to the left of the labels' frame, m.
double read_calibration(const std::string& path, KittiDrive& drive) {
  constexpr std::size_t kWords = 13;  // a name, then 3 x 4 numbers
  const WordTable table = read_words(path);
  for (const WordRow& row : table.rows) {
    if (row.words[0] != "P2:") continue;
    table.expect_at_least(row, kWords, "P2: and 12 numbers");
    drive.focal = table.number(row, 1);
    drive.cx = table.number(row, 3);
    drive.cy = table.number(row, 7);
    constexpr double kSame = 0.01;  // px
    for (const Rectified& day : kDays) {
      if (std::abs(day.focal - drive.focal) > kSame) continue;
      drive.width = day.width;
      drive.height = day.height;
      return table.number(row, 4) / drive.focal;
    }
    throw ImportProblem{table.place(row), "has a focal length of no day of KITTI: " + row.words[1],
                        "give calib.txt of the tracking data set"};
  }
  throw ImportProblem{path, "has no line P2:", "give calib.txt of the tracking data set"};
}

void read_poses(const std::string& path, KittiDrive& drive) {
  constexpr std::size_t kNumbers = 12;  // camera to world, 3 x 4, row by row
  for (const TableRow& row : read_space_table(path, kNumbers, "3 x 4 numbers, camera to world").rows) {
    const auto& m = row.values;
    KittiFrame frame;
    frame.pose.t = static_cast<double>(drive.frames.size()) / kKittiRate;
    frame.pose.x = m[11];
    frame.pose.y = -m[3];
    frame.pose.heading = std::atan2(-m[2], m[10]);
    drive.frames.push_back(frame);
  }
}

void read_labels(const std::string& path, double shift, KittiDrive& drive) {
  const WordTable table = read_words(path);
  for (const WordRow& row : table.rows) {
    table.expect_at_least(row, kLabelWords, kLabelNames);
    const int frame = table.whole(row, 0);
    if (frame < 0) throw ImportProblem{table.place(row), "has a negative frame", "frames count from 0"};
    if (row.words[2] == "DontCare") continue;
    if (static_cast<std::size_t>(frame) >= drive.frames.size()) {
      drive.frames_without_pose =
          std::max(drive.frames_without_pose, static_cast<std::size_t>(frame) + 1 - drive.frames.size());
      continue;
    }
    const auto at = [&](std::size_t index) { return table.number(row, index); };
    drive.frames[static_cast<std::size_t>(frame)].labels.push_back({table.whole(row, 1),
                                                                    row.words[2],
                                                                    table.whole(row, 4),
                                                                    {at(6), at(7), at(8), at(9)},
                                                                    at(10),
                                                                    at(11),
                                                                    at(12),
                                                                    at(13) + shift,
                                                                    at(15),
                                                                    at(16)});
  }
}

}  // namespace

Point KittiFrame::place(double right, double ahead) const {
  const double c = std::cos(pose.heading);
  const double s = std::sin(pose.heading);
  return {pose.x + c * ahead + s * right, pose.y + s * ahead - c * right};
}

KittiDrive read_kitti(const std::string& folder) {
  KittiDrive drive;
  const double shift = read_calibration(in(folder, "calib.txt"), drive);
  read_poses(in(folder, "poses.txt"), drive);
  read_labels(in(folder, "labels.txt"), shift, drive);
  return drive;
}

std::vector<std::vector<KittiBox>> read_detections(const std::string& path, std::size_t frames) {
  std::vector<std::vector<KittiBox>> boxes(frames);
  const WordTable table = read_words(path);
  for (const WordRow& row : table.rows) {
    table.expect_at_least(row, 5, "frame, x1, y1, x2, y2, score");
    const int frame = table.whole(row, 0);
    if (frame < 0 || static_cast<std::size_t>(frame) >= frames) continue;
    boxes[static_cast<std::size_t>(frame)].push_back(
        {table.number(row, 1), table.number(row, 2), table.number(row, 3), table.number(row, 4)});
  }
  return boxes;
}

}  // namespace fencepost::host
