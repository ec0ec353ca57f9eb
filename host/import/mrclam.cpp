#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "host/geometry/rings.hpp"
#include "host/import/import.hpp"
#include "host/import/log_builder.hpp"
#include "host/import/mrclam_files.hpp"
#include "host/import/table.hpp"

namespace fencepost::host {

namespace {

/// The part of the recording that is wanted, seconds from its start: from <= t < to.
struct Window {
  double from = 0;
  double to = std::numeric_limits<double>::infinity();
  [[nodiscard]] bool contains(double t) const { return t >= from && t < to; }
  [[nodiscard]] base::Time stamp(double t) const { return base::Time::nearest(t - from); }
};

/// Ten times the real camera's resolution, or whole pixels would cost 1.2 mrad; a little wider, since bearings
/// reach 0.565 rad. Mounted at the robot's origin, pitch unknown: rows are not used.
sensor::CameraIntrinsics virtual_camera() {
  sensor::CameraIntrinsics camera;
  camera.model = "mrclam x10";
  camera.width = 12'000;
  camera.height = 7'200;
  camera.fx = base::Pixels2::nearest(8'100);
  camera.fy = camera.fx;
  camera.cx = base::Pixels2::nearest((12'000 - 1) / 2.0);
  camera.cy = base::Pixels2::nearest((7'200 - 1) / 2.0);
  return camera;
}

/// m. Height of the lens from which ranges become ground rows. At 3 m a pitch known to 0.3 degrees is then 5 % of the
/// range, which is the data's own noise.
constexpr double kLensHeight = 0.3;

class MrclamImport {
 public:
  MrclamImport(MrclamRecording recording, const MrclamOptions& options)
      : recording_(std::move(recording)), options_(options) {
    window_.from = options.from.value_or(0);
    window_.to = options.to.value_or(window_.to);
    parts_.target = "import-mrclam";
    parts_.camera = virtual_camera();
    if (!options.rows) return;
    parts_.camera.mount.z = base::Metres::nearest(kLensHeight);
    parts_.camera.mount.pitch = base::Radians::nearest(0);
  }

  Imported run() {
    name_signatures();
    if (options_.poses == PoseSource::kTruth) {
      add_true_poses();
    } else {
      integrate_velocities();
    }
    if (parts_.odometry.empty()) {
      throw ImportProblem{"the window", "holds no pose", "choose --from and --to within the recording"};
    }
    add_frames();
    Imported imported;
    imported.summary.frames = parts_.frames.size();
    imported.summary.odometry = parts_.odometry.size();
    for (const auto& frame : parts_.frames) imported.summary.blobs += frame.blobs.size();
    for (const auto& [reason, count] : skipped_) imported.summary.skipped.emplace_back(reason, count);
    imported.summary.notes = notes();
    imported.truth = truth_scene();
    imported.log = build_log(parts_);
    return imported;
  }

 private:
  /// Barcodes are the signatures; where one does not fit into 255, the subjects' numbers are.
  void name_signatures() {
    barcodes_fit_ = recording_.subject_of.rbegin()->first <= 255;
    if (options_.include_robots && options_.robots_alike) {
      barcodes_fit_ = false;  // no subject of a landmark has a robot's number
      parts_.signatures.push_back({1, colour_number(0, 1), std::string_view("robot")});
    }
    std::size_t index = 0;
    for (const auto& [barcode, subject] : recording_.subject_of) {
      const std::size_t colour = index++;
      if (!wanted(subject)) continue;
      if (options_.robots_alike && subject <= kLastRobot) continue;
      const std::string kind = subject <= kLastRobot ? "robot " : "landmark ";
      parts_.signatures.push_back({signature_of(barcode, subject), colour_number(colour, recording_.subject_of.size()),
                                   std::string_view(kind + std::to_string(subject))});
    }
  }

  [[nodiscard]] bool wanted(int subject) const { return subject > kLastRobot || options_.include_robots; }
  [[nodiscard]] std::uint8_t signature_of(int barcode, int subject) const {
    if (options_.robots_alike && subject <= kLastRobot) return 1;
    return static_cast<std::uint8_t>(barcodes_fit_ ? barcode : subject);
  }

  void add_sample(double t, const TimedPose& pose) {
    const base::Time stamp = window_.stamp(t);
    if (!parts_.odometry.empty() && stamp <= parts_.odometry.back().t) {
      ++skipped_["poses less than 0.1 ms after the one before"];
      return;
    }
    parts_.odometry.push_back(
        {stamp, base::Metres::nearest(pose.x), base::Metres::nearest(pose.y), base::Radians::nearest(pose.heading)});
  }

  void add_true_poses() {
    // One sample past the end, so the window's last frames have a pose.
    bool past = false;
    for (const TimedPose& pose : recording_.truth) {
      if (pose.t < window_.from || past) continue;
      past = pose.t >= window_.to;
      add_sample(pose.t, pose);
    }
  }

  /// Zero-order hold of the velocities; each piece is an exact arc.
  void integrate_velocities() {
    const auto& rows = recording_.odometry;
    const double start = std::max(window_.from, rows.front().t);
    const auto pose_at_start = truth_at(recording_, start);
    if (!pose_at_start) {
      throw ImportProblem{"the window", "has no true pose at its start, t = " + std::to_string(start) + " s",
                          "choose --from within the survey's times"};
    }
    TimedPose pose = *pose_at_start;
    VelocityRow held = rows.front();
    bool past = false;
    bool started = false;
    for (const VelocityRow& row : rows) {
      if (past) break;
      if (row.t > start || started) {
        if (!started) add_sample(start, pose);
        started = true;
        pose = after(pose, held, row.t);
        add_sample(row.t, pose);
        past = row.t >= window_.to;
      }
      held = row;
    }
  }

  static TimedPose after(TimedPose pose, const VelocityRow& held, double t) {
    const double dt = t - pose.t;
    if (dt <= 0) return pose;  // logged twice: the later row's velocity counts
    const double turn = held.turn * dt;
    // Chord of the arc: sin(x)/x keeps straight lines exact.
    const double half = turn / 2;
    const double chord = held.forward * dt * (half == 0 ? 1 : std::sin(half) / half);
    pose.x += chord * std::cos(pose.heading + half);
    pose.y += chord * std::sin(pose.heading + half);
    pose.heading += turn;
    pose.t = t;
    return pose;
  }

  void add_frames() {
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < recording_.measurements.size();) {
      const double t = recording_.measurements[i].t;
      sensor::BlobFrame frame;
      frame.t = window_.stamp(t);
      frame.frame = number++;
      for (; i < recording_.measurements.size() && recording_.measurements[i].t == t; ++i) {
        if (window_.contains(t)) add_blob(recording_.measurements[i], frame);
      }
      if (!window_.contains(t)) continue;
      if (!parts_.frames.empty() && frame.t <= parts_.frames.back().t) {
        ++skipped_["frames less than 0.1 ms after the one before"];
        continue;
      }
      sort_by_width(frame);
      parts_.frames.push_back(frame);
    }
    if (parts_.frames.empty()) {
      throw ImportProblem{"the window", "holds no measurement", "choose --from and --to within the recording"};
    }
  }

  void add_blob(const MeasurementRow& row, sensor::BlobFrame& frame) {
    const auto known = recording_.subject_of.find(row.barcode);
    if (known == recording_.subject_of.end()) {
      ++skipped_["rows with an unknown barcode"];
      return;
    }
    if (!wanted(known->second)) {
      ++skipped_["rows that see another robot"];
      return;
    }
    const double radius = options_.diameter / 2;
    if (row.range <= radius) {
      ++skipped_["rows nearer than the landmark's radius"];
      return;
    }
    const double half = std::asin(radius / row.range);
    constexpr double kWidest = 1.3;  // rad; beyond, no flat image has a column
    sensor::Blob blob;
    blob.signature = signature_of(row.barcode, known->second);
    const double cx = parts_.camera.cx.to_double();
    const double fx = parts_.camera.fx.to_double();
    if (std::abs(row.bearing) + half > kWidest || !make_box(parts_.camera, cx - fx * std::tan(row.bearing + half),
                                                            cx - fx * std::tan(row.bearing - half), blob)) {
      ++skipped_["rows outside the camera's view"];
      return;
    }
    if (options_.rows) put_foot(row.range * std::cos(row.bearing) - radius, blob);
    if (!frame.blobs.push_back(blob)) ++skipped_["rows beyond 16 in one frame"];
  }

  // The bottom row of a thing on the floor `depth` before the lens, unless that is below the image.
  void put_foot(double depth, sensor::Blob& blob) const {
    const double row = parts_.camera.cy.to_double() + parts_.camera.fy.to_double() * kLensHeight / depth - 0.5;
    if (depth > 0 && row < blob.y2) blob.y2 = static_cast<std::int16_t>(std::lround(row));
  }

  static void sort_by_width(sensor::BlobFrame& frame) {
    std::stable_sort(frame.blobs.begin(), frame.blobs.end(),
                     [](const sensor::Blob& a, const sensor::Blob& b) { return a.x2 - a.x1 > b.x2 - b.x1; });
  }

  [[nodiscard]] std::vector<std::string> notes() const {
    std::ostringstream diameter;
    diameter << "landmarks are taken as round, " << options_.diameter << " m wide; the data do not say";
    std::vector<std::string> notes = {diameter.str()};
    if (options_.rows) notes.push_back("ranges are also ground rows, of a level camera 0.3 m above the floor");
    if (recording_.truth.empty()) {
      notes.push_back("poses are the logged velocities, integrated from (0, 0, 0): there are no true poses");
    } else if (options_.poses == PoseSource::kOdometry) {
      notes.push_back("poses are the logged velocities, integrated from the true pose at the start");
    } else {
      notes.push_back("poses are the survey's");
    }
    if (!barcodes_fit_ && !options_.robots_alike)
      notes.push_back("signatures are subject numbers: a barcode exceeds 255");
    return notes;
  }

  [[nodiscard]] Scene truth_scene() const {
    constexpr double kHeight = 0.3;  // m, assumed; rows are not used
    Scene scene;
    scene.camera = parts_.camera;
    scene.rate = 4;  // about
    for (const record::Signature& signature : parts_.signatures) {
      scene.signatures.push_back({signature.signature, std::string(signature.name.view()), signature.rgb});
    }
    for (const auto& [barcode, subject] : recording_.subject_of) {
      const auto place = recording_.landmarks.find(subject);
      if (place == recording_.landmarks.end() || !wanted(subject)) continue;
      scene.objects.push_back({"landmark " + std::to_string(subject),
                               signature_of(barcode, subject),
                               0,
                               kHeight,
                               {circle_ring(place->second, options_.diameter / 2), {}}});
    }
    return scene;
  }

  MrclamRecording recording_;
  const MrclamOptions& options_;
  Window window_;
  LogParts parts_;
  bool barcodes_fit_ = true;
  std::map<std::string, std::uint64_t> skipped_;
};

void check(const MrclamOptions& options) {
  if (!(options.diameter > 0 && options.diameter <= 1)) {
    throw ImportProblem{"--diameter", "is out of range", "allowed: more than 0, up to 1 m"};
  }
  if (options.from && !(*options.from >= 0)) {
    throw ImportProblem{"--from", "is negative", "give seconds from the recording's start"};
  }
  if (options.to && !(*options.to > options.from.value_or(0))) {
    throw ImportProblem{"--to", "is not after --from", "give seconds from the recording's start"};
  }
}

}  // namespace

ImportResult import_mrclam(const std::string& folder, const MrclamOptions& options) {
  try {
    check(options);
    return MrclamImport(read_mrclam(folder, options.robot, options.poses == PoseSource::kTruth), options).run();
  } catch (const ImportProblem& problem) {
    return problem;
  }
}

}  // namespace fencepost::host
