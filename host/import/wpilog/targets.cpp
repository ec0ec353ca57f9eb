#include "host/import/wpilog/targets.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "host/import/fields.hpp"

namespace fencepost::host {
namespace {

using Json = nlohmann::json;

constexpr double kDegree = std::numbers::pi / 180;
constexpr std::size_t kDouble = sizeof(double);
/// Longest JSON text, bytes. A result has some thousand; brackets alone take eighty times as many in memory.
constexpr std::size_t kMaxText = 1'000'000;

/// Which pixels corners mean.
enum class Corners : unsigned char {
  kPixels,  ///< centres of the outermost pixels, as those of a contour
  kEdges,   ///< edges of a rectangle, one past the last pixel
};

class BoxOfCorners {
 public:
  void add(double x, double y) {
    if (!std::isfinite(x) || !std::isfinite(y)) return;
    const Target::Box corner{x, y, x, y};
    if (!box_) box_ = corner;
    *box_ = {std::min(box_->x1, x), std::min(box_->y1, y), std::max(box_->x2, x), std::max(box_->y2, y)};
  }
  /// Corners that are all one point mean "not known".
  [[nodiscard]] std::optional<Target::Box> box(Corners meaning) const {
    if (!box_ || (box_->x1 == box_->x2 && box_->y1 == box_->y2)) return std::nullopt;
    const double beyond = meaning == Corners::kEdges ? 1 : 0;
    Target::Box pixels{std::round(box_->x1), std::round(box_->y1), std::round(box_->x2) - beyond,
                       std::round(box_->y2) - beyond};
    pixels.x2 = std::max(pixels.x1, pixels.x2);
    pixels.y2 = std::max(pixels.y1, pixels.y2);
    return pixels;
  }

 private:
  std::optional<Target::Box> box_;
};

/// A variable-length array has one byte with its length, at most 127.
std::size_t length(Fields& fields) {
  const auto count = fields.integer<std::uint8_t>();
  constexpr std::uint8_t kMax = 127;
  if (count > kMax) static_cast<void>(fields.take(fields.rest().size() + 1));  // another layout
  return count > kMax ? 0 : count;
}

BoxOfCorners corners(Fields& fields) {
  BoxOfCorners box;
  const std::size_t count = length(fields);
  for (std::size_t i = 0; i < count && !fields.ended_early(); ++i) {
    const double x = fields.real();
    box.add(x, fields.real());
  }
  return box;
}

Target photon_target(Fields& fields) {
  constexpr std::size_t kTransform = 7 * kDouble;
  Target target;
  target.yaw = kDegree * fields.real();
  target.pitch = kDegree * fields.real();
  static_cast<void>(fields.take(2 * kDouble));  // area and skew
  const auto tag = static_cast<std::int32_t>(fields.integer<std::uint32_t>());
  const auto kind = static_cast<std::int32_t>(fields.integer<std::uint32_t>());
  static_cast<void>(fields.take(sizeof(float) + 2 * kTransform + kDouble));  // confidence, transforms, ambiguity
  const BoxOfCorners smallest = corners(fields);
  const BoxOfCorners detected = corners(fields);
  const bool neural = kind >= 0;
  target.name = neural ? "class " + std::to_string(kind) : tag >= 0 ? "tag " + std::to_string(tag) : "target";
  const Corners meaning = neural ? Corners::kEdges : Corners::kPixels;
  target.box = detected.box(meaning);
  if (!target.box) target.box = smallest.box(meaning);
  return target;
}

/// multitagResult: two transforms with three numbers, and ids. Only its end matters.
void pass_multitag(Fields& fields) {
  constexpr std::size_t kNumbers = 7 + 7 + 3;
  if (fields.integer<std::uint8_t>() == 0) return;
  static_cast<void>(fields.take(kNumbers * kDouble));
  static_cast<void>(fields.take(length(fields) * sizeof(std::int16_t)));
}

Target json_target(const Json& one, const std::string& name, Corners meaning) {
  Target target;
  target.name = name;
  BoxOfCorners box;
  if (one.contains("pts")) {
    for (const Json& point : one.at("pts")) box.add(point.at(0).get<double>(), point.at(1).get<double>());
  }
  target.box = box.box(meaning);
  target.yaw = kDegree * one.value("tx", 0.0);
  target.pitch = kDegree * one.value("ty", 0.0);
  return target;
}

std::string name_of(const Json& detection) {
  if (detection.contains("class") && detection.at("class").is_string()) {
    if (const auto name = detection.at("class").get<std::string>(); !name.empty()) return name;
  }
  return "class " + std::to_string(detection.value("classID", 0));
}

}  // namespace

std::optional<TargetFrame> photon_targets(std::string_view data) {
  constexpr double kMicro = 1e-6;
  Fields fields(data);
  static_cast<void>(fields.integer<std::uint64_t>());  // number of the image
  const auto capture = static_cast<std::int64_t>(fields.integer<std::uint64_t>());
  const auto publish = static_cast<std::int64_t>(fields.integer<std::uint64_t>());
  static_cast<void>(fields.integer<std::uint64_t>());  // since the last answer of the clock's server
  TargetFrame frame;
  frame.latency = kMicro * (static_cast<double>(publish) - static_cast<double>(capture));
  const std::size_t count = length(fields);
  for (std::size_t i = 0; i < count && !fields.ended_early(); ++i) frame.targets.push_back(photon_target(fields));
  pass_multitag(fields);
  return fields.ended_early() || !fields.rest().empty() ? std::nullopt : std::optional(std::move(frame));
}

std::optional<TargetFrame> limelight_json(std::string_view text) {
  constexpr double kMilli = 1e-3;
  if (text.size() > kMaxText) return std::nullopt;
  try {
    const Json whole = Json::parse(text);
    const Json& results = whole.contains("Results") ? whole.at("Results") : whole;
    if (!results.is_object()) return std::nullopt;
    TargetFrame frame;
    frame.latency = kMilli * (results.value("tl", 0.0) + results.value("cl", 0.0));
    if (results.contains("Detector")) {
      for (const Json& one : results.at("Detector")) {
        frame.targets.push_back(json_target(one, name_of(one), Corners::kEdges));
      }
    }
    if (results.contains("Retro")) {
      for (const Json& one : results.at("Retro")) frame.targets.push_back(json_target(one, "target", Corners::kPixels));
    }
    return frame;
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

std::optional<std::vector<double>> doubles_of(std::string_view data) {
  if (data.size() % kDouble != 0) return std::nullopt;
  Fields fields(data);
  std::vector<double> values;
  while (!fields.rest().empty()) values.push_back(fields.real());
  return values;
}

std::optional<TargetFrame> limelight_detections(const std::vector<double>& values) {
  constexpr std::size_t kValues = 12;  // class, yaw, pitch, area, four corners
  constexpr std::size_t kFirstCorner = 4;
  constexpr double kMaxClass = 1e6;
  if (values.size() % kValues != 0) return std::nullopt;
  TargetFrame frame;
  for (std::size_t at = 0; at < values.size(); at += kValues) {
    const double number = values[at];
    if (!(number >= 0 && number <= kMaxClass)) return std::nullopt;
    BoxOfCorners box;
    for (std::size_t i = kFirstCorner; i < kValues; i += 2) box.add(values[at + i], values[at + i + 1]);
    frame.targets.push_back({"class " + std::to_string(static_cast<int>(number)), box.box(Corners::kEdges),
                             kDegree * values[at + 1], kDegree * values[at + 2]});
  }
  return frame;
}

std::optional<TargetFrame> limelight_corners(const std::vector<double>& values) {
  if (values.size() % 2 != 0) return std::nullopt;
  BoxOfCorners corners;
  for (std::size_t i = 0; i < values.size(); i += 2) corners.add(values[i], values[i + 1]);
  TargetFrame frame;
  if (const auto box = corners.box(Corners::kPixels)) frame.targets.push_back({"target", box, 0, 0});
  return frame;
}

TargetFrame limelight_angles(bool seen, double tx, double ty) {
  TargetFrame frame;
  if (seen) frame.targets.push_back({"target", {}, kDegree * tx, kDegree * ty});
  return frame;
}

}  // namespace fencepost::host
