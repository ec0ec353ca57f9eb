// Converts recordings of others to our record stream (formats and choices: share/doc/import.md).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hal/base/result.hpp"
#include "host/scene/scene.hpp"

namespace fencepost::host {

struct ImportError {
  std::string where;  ///< "file" or "file:line"
  std::string what;
  std::string remedy;
  [[nodiscard]] std::string message() const;  ///< "where: what; remedy"
};

struct ImportSummary {
  std::uint64_t frames = 0;
  std::uint64_t blobs = 0;
  std::uint64_t odometry = 0;
  /// Skipped items by reason, e.g. {"rows of other robots", 120}; zero counts are not listed.
  std::vector<std::pair<std::string, std::uint64_t>> skipped;
  std::vector<std::string> notes;  ///< choices worth telling the user, one sentence each
};

struct Imported {
  std::string log;             ///< a whole record stream
  std::optional<Scene> truth;  ///< where the source knows it; has no path
  ImportSummary summary;
};

using ImportResult = base::Result<Imported, ImportError>;

/// Bearing intervals of one object on a ring of views. CSV with the header
/// frame,cam_x,cam_y,cam_heading,bearing_lo,bearing_hi,lo_touches_border,hi_touches_border,excluded
/// (m, rad; bearings relative to cam_heading, counter-clockwise; lo = right end).
ImportResult import_rings(const std::string& csv_path);

enum class PoseSource : unsigned char {
  kTruth,     ///< the survey's poses as odometry
  kOdometry,  ///< the logged velocities, integrated from the true pose at the window's start; without any, from zero
};

struct MrclamOptions {
  std::optional<int> robot;  ///< RobotN_*.dat; empty: the only one there is
  PoseSource poses = PoseSource::kTruth;
  double diameter = 0.12;      ///< m, assumed of every landmark
  std::optional<double> from;  ///< s from the recording's start
  std::optional<double> to;
  bool rows = false;            ///< ranges also as ground rows of a camera of known height and pitch
  bool include_robots = false;  ///< also the other robots, which move
  bool robots_alike = false;    ///< all of one signature, 1; the landmarks' are their subjects' numbers then
};

/// UTIAS multi-robot data set (MRCLAM): a folder with RobotN_Odometry.dat, RobotN_Groundtruth.dat,
/// RobotN_Measurement.dat, Barcodes.dat, Landmark_Groundtruth.dat.
ImportResult import_mrclam(const std::string& folder, const MrclamOptions& options);

struct KittiOptions {
  double scale = 0.1;           ///< lengths of the log over those of the world
  std::optional<double> pitch;  ///< rad, configured; empty: unknown, rows are not used
  bool identity = false;        ///< a signature for each labelled track; else one for all cars
  bool ids = false;             ///< labelled tracks' numbers, as a camera that tracks would give them
  std::string detections;       ///< a file of boxes in place of the labelled ones
};

struct DlrOptions {
  bool identity = false;          ///< a signature for each disc, 31 of them in turn; else one for all
  std::size_t from = 0;           ///< step; a later one starts at the origin
  std::optional<std::size_t> to;  ///< step, not included
};

/// DLR's spatial cognition data set: the file of detected circles. No truth is known.
ImportResult import_dlr(const std::string& path, const DlrOptions& options);

/// A drive of cycloid, a 1:10 car among orange cones. `drive` has frames "dt ds gyro n" (s, cm, rad/s), each with n
/// lines of a bearing (rad, right positive). `cones` has their surveyed places (cm); empty: no truth.
ImportResult import_cycloid(const std::string& drive, const std::string& cones);

struct VictoriaOptions {
  double scale = 0.1;          ///< lengths of the log over those of the world
  bool rows = false;           ///< ranges also as ground rows of a camera of known height and pitch
  std::optional<double> from;  ///< s of the recording's clock
  std::optional<double> to;
};

/// Victoria Park: a truck among trees; a folder with measurements.dat (s, range m, bearing rad, diameter m) and
/// inputs.dat (s, m/s, rad). No truth is known but GPS, which is not read.
ImportResult import_victoria(const std::string& folder, const VictoriaOptions& options);

/// One drive of KITTI's tracking data set: a folder with labels.txt, calib.txt, poses.txt. The truth is parked cars.
ImportResult import_kitti(const std::string& folder, const KittiOptions& options);

}  // namespace fencepost::host
