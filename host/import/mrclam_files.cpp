#include "host/import/mrclam_files.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <set>

#include "host/import/table.hpp"

namespace fencepost::host {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPacked = ".gz";

/// The file of that name, or what gzip made of it.
std::string packed_or_not(const std::string& path) {
  std::error_code none;
  const bool packed = !fs::exists(path, none) && fs::exists(path + std::string(kPacked), none);
  return packed ? path + std::string(kPacked) : path;
}

std::set<int> robots_in(const std::string& folder) {
  std::set<int> robots;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    std::string name = entry.path().filename().string();
    if (name.ends_with(kPacked)) name.resize(name.size() - kPacked.size());
    constexpr std::string_view kEnd = "_Measurement.dat";
    if (name.size() == 6 + kEnd.size() && name.starts_with("Robot") && name.ends_with(kEnd) && name[5] >= '1' &&
        name[5] <= '9') {
      robots.insert(name[5] - '0');
    }
  }
  if (error) throw ImportProblem{folder, "cannot be read as a folder", "give the folder that holds RobotN_*.dat"};
  return robots;
}

int choose_robot(const std::string& folder, std::optional<int> wanted) {
  const std::set<int> robots = robots_in(folder);
  std::string list;
  for (const int robot : robots) list += (list.empty() ? "" : ", ") + std::to_string(robot);
  if (robots.empty()) {
    throw ImportProblem{folder, "has no RobotN_Measurement.dat", "give the folder of one MRCLAM data set"};
  }
  if (wanted && !robots.contains(*wanted)) {
    throw ImportProblem{folder, "has no data of robot " + std::to_string(*wanted), "there are robots: " + list};
  }
  if (!wanted && robots.size() > 1) {
    throw ImportProblem{folder, "has data of several robots", "choose one with --robot: " + list};
  }
  return wanted ? *wanted : *robots.begin();
}

int whole(double value, const char* name, const std::string& place) {
  if (value >= 0 && value < 1e6 && value == std::floor(value)) return static_cast<int>(value);
  throw ImportProblem{place, std::string(name) + " is not a whole number", "correct the line or take it out"};
}

void read_truth(const std::string& prefix, MrclamRecording& recording) {
  const Table truth = read_space_table(packed_or_not(prefix + "_Groundtruth.dat"), 4, "time, x, y, heading");
  for (const TableRow& row : truth.rows) {
    if (!recording.truth.empty() && row.values[0] < recording.truth.back().t) {
      throw ImportProblem{truth.place(row), "time runs backwards", "sort the file by time"};
    }
    recording.truth.push_back({row.values[0], row.values[1], row.values[2], row.values[3]});
  }
}

void read_tables(const std::string& folder, MrclamRecording& recording, bool poses_needed) {
  const std::string prefix = (fs::path(folder) / ("Robot" + std::to_string(recording.robot))).string();
  for (const TableRow& row : read_space_table(packed_or_not(prefix + "_Odometry.dat"), 3, "time, forward, turn").rows) {
    recording.odometry.push_back({row.values[0], row.values[1], row.values[2]});
  }
  if (poses_needed || fs::exists(packed_or_not(prefix + "_Groundtruth.dat"))) read_truth(prefix, recording);
  const Table seen = read_space_table(packed_or_not(prefix + "_Measurement.dat"), 4, "time, barcode, range, bearing");
  for (const TableRow& row : seen.rows) {
    if (!recording.measurements.empty() && row.values[0] < recording.measurements.back().t) {
      throw ImportProblem{seen.place(row), "time runs backwards", "sort the file by time"};
    }
    recording.measurements.push_back(
        {row.values[0], whole(row.values[1], "the barcode", seen.place(row)), row.values[2], row.values[3]});
  }
}

// Barcodes are the signatures where all fit, else subjects.
void refuse_numbers_without_signature(const MrclamRecording& recording, const std::string& file) {
  constexpr int kLargest = 255;
  if (recording.subject_of.empty() || recording.subject_of.rbegin()->first <= kLargest) return;
  for (const auto& [barcode, subject] : recording.subject_of) {
    if (subject <= kLargest) continue;
    throw ImportProblem{file,
                        "subject " + std::to_string(subject) + " and barcode " +
                            std::to_string(recording.subject_of.rbegin()->first) + " are both above 255",
                        "a signature is 0 to 255: number the barcodes or the subjects anew"};
  }
}

void read_survey(const std::string& folder, MrclamRecording& recording) {
  const Table barcodes =
      read_space_table(packed_or_not((fs::path(folder) / "Barcodes.dat").string()), 2, "subject, barcode");
  for (const TableRow& row : barcodes.rows) {
    const int subject = whole(row.values[0], "the subject", barcodes.place(row));
    const int barcode = whole(row.values[1], "the barcode", barcodes.place(row));
    if (!recording.subject_of.emplace(barcode, subject).second) {
      throw ImportProblem{barcodes.place(row), "barcode " + std::to_string(barcode) + " is there twice",
                          "each subject has one of its own"};
    }
  }
  refuse_numbers_without_signature(recording, barcodes.file);
  const std::string survey = packed_or_not((fs::path(folder) / "Landmark_Groundtruth.dat").string());
  const Table landmarks = read_space_table(survey, 5, "subject, x, y, x std-dev, y std-dev");
  for (const TableRow& row : landmarks.rows) {
    recording.landmarks[whole(row.values[0], "the subject", landmarks.place(row))] = {row.values[1], row.values[2]};
  }
}

void start_at_zero(MrclamRecording& recording) {
  double start = std::min(recording.odometry.front().t, recording.measurements.front().t);
  if (!recording.truth.empty()) start = std::min(start, recording.truth.front().t);
  for (VelocityRow& row : recording.odometry) row.t -= start;
  for (TimedPose& pose : recording.truth) pose.t -= start;
  for (MeasurementRow& row : recording.measurements) row.t -= start;
}

}  // namespace

MrclamRecording read_mrclam(const std::string& folder, std::optional<int> robot, bool poses_needed) {
  MrclamRecording recording;
  recording.robot = choose_robot(folder, robot);
  read_tables(folder, recording, poses_needed);
  read_survey(folder, recording);
  start_at_zero(recording);
  return recording;
}

std::optional<TimedPose> truth_at(const MrclamRecording& recording, double t) {
  const auto& truth = recording.truth;
  if (truth.empty()) return TimedPose{t, 0, 0, 0};
  if (t < truth.front().t || t > truth.back().t) return std::nullopt;
  const auto after =
      std::upper_bound(truth.begin(), truth.end(), t, [](double time, const TimedPose& pose) { return time < pose.t; });
  if (after == truth.end()) return truth.back();
  const TimedPose& a = *(after - 1);
  const double share = (t - a.t) / (after->t - a.t);
  const double turn = std::remainder(after->heading - a.heading, 2 * std::numbers::pi);
  return TimedPose{t, a.x + share * (after->x - a.x), a.y + share * (after->y - a.y), a.heading + share * turn};
}

}  // namespace fencepost::host
