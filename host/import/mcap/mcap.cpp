#include "host/import/mcap/mcap.hpp"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "host/import/mcap/cdr.hpp"
#include "host/import/mcap/mcap_file.hpp"
#include "host/import/table.hpp"
#include "host/import/text_lines.hpp"
#include "host/text/plural.hpp"

namespace fencepost::host {
namespace {

using Json = nlohmann::json;

struct Detection {
  std::string name;
  double score = -1;
  double x = 0;  ///< px, of the box's middle
  double y = 0;
  double width = 0;
  double height = 0;
  std::string track;  ///< its id; empty: none
};
struct Detections {
  double t = 0;
  std::vector<Detection> list;
};

double yaw_of(double x, double y, double z, double w) {
  return std::atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z));
}

/// std_msgs/msg/Header; its time.
double header(CdrReader& cdr) {
  const auto seconds = static_cast<std::int32_t>(cdr.whole());
  const double t = seconds + cdr.whole() * 1e-9;
  static_cast<void>(cdr.string());
  return t;
}

constexpr std::size_t kPose = 7;
constexpr std::size_t kCovariance = 36;

std::optional<Detections> detections_in_cdr(std::string_view data) {
  CdrReader cdr(data);
  Detections detections{header(cdr), {}};
  const std::uint32_t count = cdr.whole();
  for (std::uint32_t i = 0; i < count && !cdr.failed(); ++i) {
    Detection detection;
    static_cast<void>(header(cdr));
    const std::uint32_t results = cdr.whole();
    for (std::uint32_t k = 0; k < results && !cdr.failed(); ++k) {
      const std::string name(cdr.string());
      const double score = cdr.real();
      cdr.pass_reals(kPose + kCovariance);
      if (score <= detection.score) continue;
      detection.score = score;
      detection.name = name;
    }
    detection.x = cdr.real();
    detection.y = cdr.real();
    static_cast<void>(cdr.real());  // its turn in the image
    detection.width = cdr.real();
    detection.height = cdr.real();
    detection.track = cdr.string();
    detections.list.push_back(detection);
  }
  return cdr.at_end() ? std::optional(detections) : std::nullopt;
}

std::optional<TimedPose> pose_in_cdr(std::string_view data) {
  CdrReader cdr(data);
  TimedPose pose{header(cdr), 0, 0, 0};
  static_cast<void>(cdr.string());  // child_frame_id
  pose.x = cdr.real();
  pose.y = cdr.real();
  static_cast<void>(cdr.real());
  const double x = cdr.real();
  const double y = cdr.real();
  const double z = cdr.real();
  pose.heading = yaw_of(x, y, z, cdr.real());
  return cdr.failed() ? std::nullopt : std::optional(pose);
}

double json_time(const Json& message) {
  const Json& stamp = message.at("header").at("stamp");
  const double fine = stamp.contains("nanosec") ? stamp.at("nanosec").get<double>() : stamp.value("nsec", 0.0);
  return stamp.at("sec").get<double>() + 1e-9 * fine;
}

std::string text_of(const Json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

Detections detections_in_json(const Json& message) {
  Detections detections{json_time(message), {}};
  for (const Json& one : message.at("detections")) {
    Detection detection;
    for (const Json& result : one.at("results")) {
      const Json& hypothesis = result.contains("hypothesis") ? result.at("hypothesis") : result;
      const double score = hypothesis.value("score", 0.0);
      if (score <= detection.score) continue;
      detection.score = score;
      detection.name = text_of(hypothesis.at(hypothesis.contains("class_id") ? "class_id" : "id"));
    }
    const Json& box = one.at("bbox");
    const Json& centre = box.at("center").contains("position") ? box.at("center").at("position") : box.at("center");
    detection.x = centre.at("x").get<double>();
    detection.y = centre.at("y").get<double>();
    detection.width = box.at("size_x").get<double>();
    detection.height = box.at("size_y").get<double>();
    if (const auto id = one.find("id"); id != one.end()) detection.track = text_of(*id);
    detections.list.push_back(detection);
  }
  return detections;
}

TimedPose pose_in_json(const Json& message) {
  const Json& pose = message.at("pose").contains("pose") ? message.at("pose").at("pose") : message.at("pose");
  const Json& turn = pose.at("orientation");
  return {json_time(message), pose.at("position").at("x").get<double>(), pose.at("position").at("y").get<double>(),
          yaw_of(turn.at("x").get<double>(), turn.at("y").get<double>(), turn.at("z").get<double>(),
                 turn.at("w").get<double>())};
}

class McapImport {
 public:
  McapImport(std::string file, const McapTopics& topics) : file_(std::move(file)), topics_(topics) {}

  void take(const McapMessage& message) {
    ++number_;
    const bool boxes = message.schema.find("Detection2DArray") != std::string_view::npos;
    const bool poses = message.schema.find("Odometry") != std::string_view::npos;
    std::string& wanted = boxes ? topics_.detections : topics_.odometry;
    if (!boxes && !poses) {
      others_.emplace(message.topic, message.schema);
      ++taken_.skipped["messages of other kinds"];
      return;
    }
    if (wanted.empty()) wanted = message.topic;
    if (wanted != message.topic) {
      ++taken_.skipped["messages of " + quoted(message.topic)];
      return;
    }
    used_ += message.data.size();
    if (used_ > kMaxUsed) {
      throw ImportProblem{file_, "has more than " + std::to_string(kMaxUsed / 1'000'000) + " MB of " + wanted,
                          "make a part of it with 'mcap filter'"};
    }
    if (message.encoding == "cdr") {
      take_cdr(message, boxes);
    } else if (message.encoding == "json") {
      take_json(message, boxes);
    } else {
      throw ImportProblem{file_ + ": " + std::string(message.topic),
                          "is encoded as \"" + std::string(message.encoding) + "\"", "cdr and json can be read"};
    }
  }
  Taken finish() {
    if (taken_.frames.empty() && taken_.poses.empty()) throw nothing();
    for (const auto& [name, number] : numbers_) taken_.names[number] = name;
    return std::move(taken_);
  }

 private:
  [[nodiscard]] ImportProblem unexpected(const McapMessage& message) const {
    return {file_ + ": message " + std::to_string(number_) + " of " + std::string(message.topic),
            "is not laid out as " + std::string(message.schema) + " of ROS 2 is",
            "vision_msgs 4 and nav_msgs of Humble or later can be read"};
  }
  [[nodiscard]] ImportProblem nothing() const {
    constexpr std::size_t kShown = 6;
    std::string topics;
    for (const auto& [topic, schema] : others_) {
      if (topics.size() > kShown * 40) break;
      topics +=
          (topics.empty() ? "" : ", ") + quoted(std::string_view(topic)) + " of " + quoted(std::string_view(schema));
    }
    return {file_, "has " + plural(number_, "message") + ", none of Detection2DArray or Odometry",
            topics.empty() ? "record some with 'ros2 bag record'" : "it has " + topics};
  }
  void take_cdr(const McapMessage& message, bool boxes) {
    if (boxes) {
      const auto detections = detections_in_cdr(message.data);
      if (!detections) throw unexpected(message);
      add(*detections, message.log_time);
    } else {
      auto pose = pose_in_cdr(message.data);
      if (!pose) throw unexpected(message);
      if (pose->t == 0) pose->t = message.log_time;
      taken_.poses.push_back(*pose);
    }
  }
  void take_json(const McapMessage& message, bool boxes) {
    constexpr std::size_t kMaxMessage = 1'000'000;  // bytes; parsed, brackets alone take eighty times as many
    if (message.data.size() > kMaxMessage) throw unexpected(message);
    try {
      const Json json = Json::parse(message.data);
      if (boxes) return add(detections_in_json(json), message.log_time);
      taken_.poses.push_back(pose_in_json(json));
      if (taken_.poses.back().t == 0) taken_.poses.back().t = message.log_time;
    } catch (const Json::exception&) {
      throw unexpected(message);
    }
  }
  void add(const Detections& detections, double log_time) {
    TakenFrame frame{detections.t > 0 ? detections.t : log_time, {}};
    for (const Detection& detection : detections.list) {
      ImportedBlob blob;
      blob.signature = numbers_.try_emplace(detection.name, static_cast<int>(numbers_.size()) + 1).first->second;
      blob.track = id_of(detection.track);
      // Continuous edges, whose pixels are centred on whole numbers.
      blob.x1 = std::round(detection.x - detection.width / 2);
      blob.x2 = std::max(blob.x1, std::round(detection.x + detection.width / 2) - 1);
      blob.y1 = std::round(detection.y - detection.height / 2);
      blob.y2 = std::max(blob.y1, std::round(detection.y + detection.height / 2) - 1);
      blob.bearing = detection.width == 0;
      if (blob.bearing) {
        blob.cx = detection.x - 0.5;
        blob.cy = detection.y - 0.5;
      }
      frame.blobs.push_back(blob);
    }
    taken_.frames.push_back(std::move(frame));
  }

  /// Ids are any texts: numbered in order of appearance, those after the last number again from the first.
  std::uint16_t id_of(const std::string& track) {
    if (track.empty()) return 0;
    const std::size_t next = tracks_.size() % std::numeric_limits<std::uint16_t>::max();
    return tracks_.try_emplace(track, static_cast<std::uint16_t>(1 + next)).first->second;
  }

  /// Bytes of messages that are imported: four hours of odometry at 100 Hz. Chunks of 4 KB can hold as many.
  static constexpr std::size_t kMaxUsed = 1'000'000'000;

  std::string file_;
  McapTopics topics_;
  std::size_t used_ = 0;
  std::uint64_t number_ = 0;
  std::map<std::string, int> numbers_;
  std::map<std::string, std::uint16_t> tracks_;
  std::map<std::string, std::string> others_;  ///< topics of other kinds, with their types
  Taken taken_;
};

}  // namespace

ImportResult import_mcap(std::string_view bytes, const std::string& file, const McapTopics& topics,
                         const TakeSettings& settings) {
  try {
    McapImport reader(file, topics);
    const McapEnd end = read_mcap(bytes, file, [&](const McapMessage& message) { reader.take(message); });
    Taken taken = reader.finish();
    if (end.truncated) taken.notes.emplace_back("the file was cut off; it was read as far as it goes");
    return log_of(std::move(taken), settings, file, "import-mcap");
  } catch (const ImportProblem& problem) {
    return problem;
  }
}

}  // namespace fencepost::host
