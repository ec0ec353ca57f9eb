// Actions of the second program, fencepost-lab, for commands that need large libraries. The second program has every
// command. The first one has all but these actions; for them it starts the second with its own command line.
// The linker chooses: lab/ has the actions, start_lab.cpp stands for them in the first program.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/cli/exit_code.hpp"

namespace fencepost::host {
struct DlrOptions;
struct EvaluateOptions;
struct KittiOptions;
struct VictoriaOptions;
struct Scene;
struct SmoothEvaluation;
namespace doctor {
struct Finding;
}
namespace exports {
struct Drawing;
}
}  // namespace fencepost::host

namespace fencepost::host::cli {

struct CalibrateRequest {
  std::string log;
  std::string camera;
  std::string robot;
  std::vector<std::string> sizes;
  std::vector<std::string> distances;
  std::string write_camera;
  std::string write_robot;
  std::string picture;
  std::string output = "-";
  bool json = false;
  std::optional<double> from;
  std::optional<double> to;
};
Exit run_calibrate(const CalibrateRequest& request);

/// A data set: its folder or file, and the part to use.
struct SetRequest {
  std::string source;
  std::string truth;
  std::string output = "-";
  std::optional<int> robot;
  std::string poses = "truth";
  double diameter = 0.12;  ///< m
  std::optional<double> from;
  std::optional<double> to;
  bool rows = false;
  bool include_robots = false;
};
Exit run_import_mrclam(const SetRequest& request);
Exit run_import_rings(const SetRequest& request);
Exit run_import_cycloid(const SetRequest& request, const std::string& cones);
Exit run_import_victoria(const SetRequest& request, const VictoriaOptions& options);
Exit run_import_dlr(const SetRequest& request, const DlrOptions& options);
Exit run_import_kitti(const SetRequest& request, const KittiOptions& options);

struct MergeRequest {
  std::vector<std::string> logs;
  std::string camera;
  std::string profile;
  std::string output = "-";
  bool json = false;
};
Exit run_merge(const MergeRequest& request);

struct PaperRequest {
  std::string log;
  std::string scene;
  std::string images;
  std::string output = "fencepost-paper";
  std::uint64_t seed = 1;
  std::size_t scenes = 60;
  std::size_t single_scenes = 20;
};
Exit run_paper(const PaperRequest& request);

struct SegmentRequest {
  std::vector<std::string> images;
  std::string poses;
  std::string poses_of = "camera";
  double scale = 1;  ///< m that one unit of the poses is
  std::string camera;
  std::string signatures;
  std::vector<std::string> colours;
  std::string background = "find";
  bool silhouette = false;
  int rotate = 0;  ///< degrees
  bool undistort = false;
  std::optional<double> spatial;
  double range = 16;
  std::optional<int> min_pixels;
  std::optional<int> max_gap;
  std::optional<int> border;
  std::string labelled;
  std::string output = "-";
};
Exit run_segment(const SegmentRequest& request);

struct SmoothRequest {
  std::string log;
  std::string camera;
  std::string profile;
  std::string report;
  std::string output = "-";
  bool calibrate = false;
  bool json = false;
  std::optional<double> from;
  std::optional<double> to;
};
Exit run_smooth(const SmoothRequest& request);

/// Before any input is read: starts the second program if it is there; true in it, false without it.
bool has_lab();
/// Judges the distances that a log's boxes have. `log`: its name on a command line.
std::vector<doctor::Finding> distance_findings(std::string_view bytes, const std::string& log);

/// To be called before any input is read for `what`, which only the second program can do. The first one ends here, and
/// the rest runs in the second.
void need_lab(const char* what);
/// errors: Failure
SmoothEvaluation smooth_log(const std::string& log, const Scene& scene, const EvaluateOptions& options);
/// `text` or JSON of an evaluation, and the same of the optima.
std::string with_smoothed(const std::string& text, bool json, const std::vector<SmoothEvaluation>& smoothed);
/// The bytes of a PNG file.
std::string png_file(const exports::Drawing& drawing, double scale);

}  // namespace fencepost::host::cli
