#include <algorithm>
#include <cmath>

#include "host/import/import.hpp"
#include "host/import/log_builder.hpp"
#include "host/import/table.hpp"

namespace fencepost::host {

namespace {

constexpr const char* kHeader =
    "frame,cam_x,cam_y,cam_heading,bearing_lo,bearing_hi,lo_touches_border,hi_touches_border,excluded";

struct RingView {
  std::uint32_t frame = 0;
  double x = 0;
  double y = 0;
  double heading = 0;
  double right = 0;  ///< bearing, rad
  double left = 0;
  bool right_on_border = false;
  bool left_on_border = false;
  bool excluded = false;
};

bool to_flag(double value, const char* name, const std::string& place) {
  if (value == 0 || value == 1) return value == 1;
  throw ImportProblem{place, std::string(name) + " is neither 0 nor 1", "write 1 for yes, 0 for no"};
}

RingView to_view(const Table& table, const TableRow& row) {
  constexpr double kWidest = 1.2;  // rad off the axis; a flat image reaches no farther
  const std::string place = table.place(row);
  const std::vector<double>& v = row.values;
  if (v[0] < 0 || v[0] > 1e9 || v[0] != std::floor(v[0])) {
    throw ImportProblem{place, "frame is not a whole number", "number the frames from 0"};
  }
  constexpr double kFarthest = 1'000;  // m: the stream's range
  if (std::abs(v[1]) > kFarthest || std::abs(v[2]) > kFarthest) {
    throw ImportProblem{place, "cam_x or cam_y is out of range, -1000 to 1000 m", "positions are metres"};
  }
  constexpr double kMaxTurn = 1'000;  // rad, whole turns included
  if (std::abs(v[3]) > kMaxTurn) {
    throw ImportProblem{place, "cam_heading is out of range, -1000 to 1000 rad", "headings are radians"};
  }
  if (!(v[4] < v[5])) {
    throw ImportProblem{place, "bearing_lo is not less than bearing_hi",
                        "lo is the right end, hi the left end; bearings grow counter-clockwise"};
  }
  if (std::abs(v[4]) > kWidest || std::abs(v[5]) > kWidest) {
    throw ImportProblem{place, "a bearing is more than 1.2 rad off the camera's axis",
                        "bearings are radians relative to cam_heading"};
  }
  return {static_cast<std::uint32_t>(v[0]),
          v[1],
          v[2],
          v[3],
          v[4],
          v[5],
          to_flag(v[6], "lo_touches_border", place),
          to_flag(v[7], "hi_touches_border", place),
          to_flag(v[8], "excluded", place)};
}

/// As fine as the stream's pixel range allows: 32000 px of focal length, so 0.03 mrad a pixel, 20 um at 0.63 m.
sensor::CameraIntrinsics camera_for(const std::vector<RingView>& views) {
  constexpr double kFinest = 32'000;
  constexpr double kMaxColumns = 32'000;
  constexpr double kMargin = 64;  // columns on each side that no unbounded end may reach
  double widest = 1e-3;
  for (const RingView& view : views) {
    widest = std::max({widest, std::abs(std::tan(view.left)), std::abs(std::tan(view.right))});
  }
  const double focus = std::min(kFinest, std::floor((kMaxColumns / 2 - kMargin) / widest));
  sensor::CameraIntrinsics camera;
  camera.model = "ring";
  camera.width = static_cast<std::uint16_t>(2 * static_cast<int>(std::ceil(focus * widest + kMargin)));
  camera.height = 480;
  camera.fx = base::Pixels2::nearest(focus);
  camera.fy = camera.fx;
  camera.cx = base::Pixels2::nearest((camera.width - 1) / 2.0);
  camera.cy = base::Pixels2::nearest((camera.height - 1) / 2.0);
  return camera;  // mount at the robot's origin, pitch unknown, no latency
}

sensor::BlobFrame to_frame(const RingView& view, base::Time t, base::Radians heading,
                           const sensor::CameraIntrinsics& camera) {
  // The stream rounds headings to 0.1 mrad; the columns are taken relative to the rounded one, so none is lost.
  const double shift = view.heading - heading.to_double();
  const double cx = camera.cx.to_double();
  const double fx = camera.fx.to_double();
  const double left = view.left_on_border ? -0.5 : cx - fx * std::tan(view.left + shift);
  const double right = view.right_on_border ? camera.width - 0.5 : cx - fx * std::tan(view.right + shift);
  sensor::BlobFrame frame;
  frame.t = t;
  frame.frame = view.frame;
  sensor::Blob blob;
  blob.signature = 1;
  if (make_box(camera, left, right, blob)) (void)frame.blobs.push_back(blob);
  return frame;
}

Imported import_views(const Table& table) {
  constexpr base::Duration kPeriod = base::milliseconds(100);
  std::vector<RingView> views;
  Imported imported;
  std::uint64_t excluded = 0;
  for (const TableRow& row : table.rows) {
    const RingView view = to_view(table, row);
    if (view.excluded) {
      ++excluded;
    } else {
      views.push_back(view);
    }
  }
  if (views.empty()) throw ImportProblem{table.file, "every view is excluded", "set excluded to 0 for the good ones"};
  LogParts parts;
  parts.target = "import-rings";
  parts.camera = camera_for(views);
  parts.signatures.push_back({1, {0xa0, 0xa0, 0xa0}, "silhouette"});
  base::Time t{0};
  for (const RingView& view : views) {
    const base::Radians heading = base::Radians::nearest(view.heading);
    parts.odometry.push_back({t, base::Metres::nearest(view.x), base::Metres::nearest(view.y), heading});
    parts.frames.push_back(to_frame(view, t, heading, parts.camera));
    imported.summary.blobs += parts.frames.back().blobs.size();
    t = t + kPeriod;
  }
  imported.log = build_log(parts);
  imported.summary.frames = parts.frames.size();
  imported.summary.odometry = parts.odometry.size();
  if (excluded > 0) imported.summary.skipped.emplace_back("views marked excluded", excluded);
  imported.summary.notes.push_back("times are made up: one view every 0.1 s");
  return imported;
}

}  // namespace

ImportResult import_rings(const std::string& csv_path) {
  try {
    return import_views(read_csv_table(csv_path, kHeader));
  } catch (const ImportProblem& problem) {
    return problem;
  }
}

}  // namespace fencepost::host
