#include "host/import/wpilog/wpilog.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "host/import/fields.hpp"
#include "host/import/table.hpp"
#include "host/import/text_lines.hpp"
#include "host/import/wpilog/targets.hpp"
#include "host/import/wpilog/wpilog_file.hpp"

namespace fencepost::host {
namespace {

/// Frames, and poses, of one log: four hours at 250 a second.
constexpr std::size_t kMaxItems = 4'000'000;

/// In order of how much they say.
enum class Boxes : unsigned char { kPhoton, kJson, kDetections, kCorners, kAngles };
enum class Poses : unsigned char { kPose2d, kPose3d, kField };

std::string_view leaf_of(std::string_view name) { return name.substr(name.rfind('/') + 1); }
/// With its slash.
std::string_view table_of(std::string_view name) { return name.substr(0, name.rfind('/') + 1); }

std::optional<Boxes> boxes_in(std::string_view name, std::string_view type) {
  const std::string_view leaf = leaf_of(name);
  if (type.starts_with("photonstruct:PhotonPipelineResult")) return Boxes::kPhoton;
  if (type == "raw" && leaf == "rawBytes") return Boxes::kPhoton;
  if ((type == "string" || type == "json") && leaf == "json") return Boxes::kJson;
  if (type == "double[]" && leaf == "rawdetections") return Boxes::kDetections;
  if (type == "double[]" && leaf == "tcornxy") return Boxes::kCorners;
  if (type == "double" && leaf == "tx") return Boxes::kAngles;
  return std::nullopt;
}

bool has_one_of(std::string_view text, std::initializer_list<std::string_view> words) {
  return std::ranges::any_of(words, [&](std::string_view word) { return text.find(word) != std::string_view::npos; });
}

/// How much a name sounds like where the robot is by its wheels; less is better. A log has poses of other things, too.
int rank_of_pose(std::string_view name) {
  constexpr int kOther = 10;
  const std::string low = lower(name);
  int rank = 2;
  if (has_one_of(low, {"odometry"})) {
    rank = 0;
  } else if (has_one_of(low, {"pose", "robot"})) {
    rank = 1;
  }
  const bool other = has_one_of(low, {"target", "goal", "traj", "vision", "auto", "setpoint", "desired", "ghost",
                                      "limelight", "photon", "camera", "tag"});
  return other ? rank + kOther : rank;
}

struct Known {
  int rank = 0;
  std::size_t order = 0;  ///< of its first record
  std::string type;
};

/// Entries of a log, by a first reading.
class Contents {
 public:
  void see(const WpilogRecord& record) {
    ++records_;
    const std::string name(record.name);
    if (leaf_of(name) == ".type" && record.data == "Field2d") fields_.emplace(table_of(name), 0);
    if (const auto kind = boxes_in(name, record.type)) {
      // A Limelight writes all of its arrays, the unused ones empty.
      constexpr int kEmpty = 10;
      const int rank = static_cast<int>(*kind) + (record.data.empty() ? kEmpty : 0);
      Known& known = boxes_.try_emplace(name, Known{rank, records_, std::string(record.type)}).first->second;
      known.rank = std::min(known.rank, rank);
    } else if (pose_in(name, record.type)) {
      poses_.try_emplace(name, Known{rank_of_pose(name), records_, std::string(record.type)});
    } else {
      others_.emplace(name, record.type);
    }
  }
  [[nodiscard]] std::optional<Poses> pose_in(std::string_view name, std::string_view type) const {
    if (type == "struct:Pose2d") return Poses::kPose2d;
    if (type == "struct:Pose3d") return Poses::kPose3d;
    const bool field = type == "double[]" && leaf_of(name) == "Robot" && fields_.contains(std::string(table_of(name)));
    return field ? std::optional(Poses::kField) : std::nullopt;
  }
  /// The entry that was asked for, or the best; empty: there is none. errors: ImportProblem: it is not there
  [[nodiscard]] std::string boxes(const std::string& wanted, const std::string& file) const {
    return choose(boxes_, wanted, file, "--detections");
  }
  [[nodiscard]] std::string poses(const std::string& wanted, const std::string& file) const {
    return choose(poses_, wanted, file, "--odometry");
  }
  /// "boxes are of A; --detections takes B, C", where there is a choice.
  void explain(const std::string& what, const std::string& chosen, Taken& taken) const {
    const bool boxes = what == "boxes";
    std::string others;
    for (const auto& [name, known] : boxes ? boxes_ : poses_) {
      if (name != chosen) add(others, name);
    }
    if (chosen.empty()) return;
    std::string note = what + " are of " + quoted(std::string_view(chosen));
    if (!others.empty()) note += (boxes ? "; --detections" : "; --odometry") + std::string(" takes others: ") + others;
    taken.notes.push_back(note);
  }
  [[nodiscard]] ImportProblem nothing(const std::string& file) const {
    std::string names;
    for (const auto& [name, type] : others_) add(names, name + " of " + type);
    return {file,
            "has " + std::to_string(records_) +
                " records, none of PhotonVision, of a Limelight, of a struct:Pose2d or of a Field2d",
            names.empty() ? "log NetworkTables with DataLogManager" : "it has " + names};
  }

 private:
  static void add(std::string& list, const std::string& name) {
    constexpr std::size_t kShown = 240;  // characters
    if (list.ends_with("...")) return;
    list += (list.empty() ? "" : ", ") + (list.size() > kShown ? "..." : quoted(std::string_view(name)));
  }
  static std::string choose(const std::map<std::string, Known>& all, const std::string& wanted, const std::string& file,
                            const std::string& option) {
    if (!wanted.empty()) {
      if (all.contains(wanted)) return wanted;
      std::string names;
      for (const auto& [name, known] : all) add(names, name);
      throw ImportProblem{file, "has no " + quoted(std::string_view(wanted)) + " that " + option + " can take",
                          names.empty() ? "it has none" : "it has " + names};
    }
    const auto best = std::ranges::min_element(all, [](const auto& a, const auto& b) {
      return std::pair(a.second.rank, a.second.order) < std::pair(b.second.rank, b.second.order);
    });
    return best == all.end() ? std::string() : best->first;
  }

  std::size_t records_ = 0;
  std::map<std::string, Known> boxes_;
  std::map<std::string, Known> poses_;
  std::map<std::string, std::string> others_;  ///< with their types
  std::map<std::string, int> fields_;          ///< tables of a Field2d
};

std::optional<TimedPose> pose_of(Poses kind, const WpilogRecord& record) {
  constexpr double kFarthest = 100'000;  // m
  constexpr double kMaxTurn = 1e6;       // rad
  Fields fields(record.data);
  TimedPose pose{record.t, fields.real(), fields.real(), 0};
  if (kind == Poses::kPose3d) {
    static_cast<void>(fields.real());  // z
    const double w = fields.real();
    const double x = fields.real();
    const double y = fields.real();
    const double z = fields.real();
    pose.heading = std::atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z));
  } else {
    const double turned = fields.real();
    pose.heading = kind == Poses::kField ? turned * std::numbers::pi / 180 : turned;
  }
  const bool sound = std::abs(pose.x) <= kFarthest && std::abs(pose.y) <= kFarthest &&
                     std::abs(pose.heading) <= kMaxTurn && !fields.ended_early() && fields.rest().empty();
  return sound ? std::optional(pose) : std::nullopt;
}

class WpilogImport {
 public:
  WpilogImport(const Contents& contents, std::string boxes, std::string poses,
               const std::optional<sensor::CameraIntrinsics>& camera)
      : contents_(contents), boxes_(std::move(boxes)), poses_(std::move(poses)), camera_(camera) {}

  void take(const WpilogRecord& record) {
    if (record.name == poses_) return take_pose(record);
    if (record.name == boxes_) return take_boxes(record);
    // Beside the boxes of a Limelight.
    if (record.type != "double" || table_of(record.name) != table_of(boxes_)) return;
    const auto values = doubles_of(record.data);
    if (!values || values->size() != 1 || !std::isfinite(values->front())) return;
    const std::string_view leaf = leaf_of(record.name);
    const double value = values->front();
    if (leaf == "tl") pipeline_ms_ = value;
    if (leaf == "cl") capture_ms_ = value;
    if (leaf == "ty") ty_ = value;
    if (leaf == "tv") seen_ = value != 0;
  }
  Taken finish() {
    for (const auto& [name, number] : numbers_) taken_.names[number] = name;
    return std::move(taken_);
  }
  [[nodiscard]] std::size_t items() const { return std::max(taken_.frames.size(), taken_.poses.size()); }

 private:
  void take_pose(const WpilogRecord& record) {
    if (const auto pose = pose_of(*contents_.pose_in(record.name, record.type), record)) {
      taken_.poses.push_back(*pose);
    } else {
      ++taken_.skipped["poses that are none"];
    }
  }
  void take_boxes(const WpilogRecord& record) {
    const auto kind = boxes_in(record.name, record.type);
    std::optional<TargetFrame> frame;
    if (kind == Boxes::kPhoton) {
      frame = photon_targets(record.data);
    } else if (kind == Boxes::kJson) {
      frame = limelight_json(record.data);
    } else if (const auto values = doubles_of(record.data)) {
      frame = kind == Boxes::kDetections ? limelight_detections(*values)
              : kind == Boxes::kCorners
                  ? limelight_corners(*values)
                  : (values->size() == 1 ? std::optional(limelight_angles(seen_, values->front(), ty_)) : std::nullopt);
      if (frame) frame->latency = 1e-3 * (pipeline_ms_ + capture_ms_);
    }
    if (!frame) {
      ++taken_.skipped["results of another layout"];
    } else {
      add(*frame, record.t);
    }
  }
  void add(const TargetFrame& targets, double t) {
    constexpr double kLongest = 1;  // s; beyond, the clocks are not one
    const bool known = targets.latency >= 0 && targets.latency <= kLongest;
    if (!known) ++taken_.skipped["latencies of less than 0 or more than 1 s"];
    TakenFrame frame{known ? t - targets.latency : t, {}};
    for (const Target& target : targets.targets) frame.blobs.push_back(blob_of(target));
    taken_.frames.push_back(std::move(frame));
  }
  ImportedBlob blob_of(const Target& target) {
    ImportedBlob blob;
    blob.signature = numbers_.try_emplace(target.name, static_cast<int>(numbers_.size()) + 1).first->second;
    if (target.box) {
      blob.x1 = target.box->x1;
      blob.y1 = target.box->y1;
      blob.x2 = target.box->x2;
      blob.y2 = target.box->y2;
    } else if (camera_) {
      blob.bearing = true;
      blob.cx = camera_->cx.to_double() + camera_->fx.to_double() * std::tan(target.yaw);
      blob.cy = camera_->cy.to_double() - camera_->fy.to_double() * std::tan(target.pitch);
    }
    return blob;
  }

  const Contents& contents_;
  std::string boxes_, poses_;
  const std::optional<sensor::CameraIntrinsics>& camera_;
  double pipeline_ms_ = 0, capture_ms_ = 0, ty_ = 0;
  bool seen_ = true;
  std::map<std::string, int> numbers_;
  Taken taken_;
};

}  // namespace

ImportResult import_wpilog(std::string_view bytes, const std::string& file, const WpilogTopics& topics,
                           const TakeSettings& settings) {
  try {
    Contents contents;
    const WpilogEnd end = read_wpilog(bytes, file, [&](const WpilogRecord& record) { contents.see(record); });
    const std::string boxes = contents.boxes(topics.detections, file);
    const std::string poses = contents.poses(topics.odometry, file);
    if (boxes.empty() && poses.empty()) throw contents.nothing(file);
    WpilogImport import(contents, boxes, poses, settings.camera);
    static_cast<void>(read_wpilog(bytes, file, [&](const WpilogRecord& record) {
      import.take(record);
      if (import.items() > kMaxItems) {
        throw ImportProblem{file, "has more than " + std::to_string(kMaxItems) + " frames or poses",
                            "log fewer of them a second"};
      }
    }));
    Taken taken = import.finish();
    contents.explain("boxes", boxes, taken);
    contents.explain("poses", poses, taken);
    if (end.unknown > 0) taken.skipped["records of entries that were not started"] += end.unknown;
    if (end.truncated) taken.notes.emplace_back("the file was cut off; it was read as far as it goes");
    return log_of(std::move(taken), settings, file, "import-wpilog");
  } catch (const ImportProblem& problem) {
    return problem;
  }
}

}  // namespace fencepost::host
