#include "firmware/fencepost/convert.hpp"

#include <algorithm>
#include <array>

#include "firmware/config/settings.hpp"
#include "firmware/record/decimal.hpp"
#include "firmware/record/layout.hpp"

namespace fencepost::library {
namespace {

// False for what is no number, too. A tenth of a millimetre is kept up to 400 m.
template <class Unit>
[[nodiscard]] bool put(float value, const record::NumberField& field, Unit& out) {
  const float scaled = value * static_cast<float>(Unit::kPerUnit);
  const bool within = scaled >= static_cast<float>(field.min) && scaled <= static_cast<float>(field.max);
  if (within) out.raw = static_cast<typename Unit::rep>(scaled < 0 ? scaled - 0.5F : scaled + 0.5F);
  return within;
}

[[nodiscard]] bool put_mount(const fencepost_camera& camera, sensor::CameraMount& mount) {
  if (!camera.pitch_unknown) {
    base::Radians pitch;
    if (!put(camera.pitch, record::kPitch, pitch)) return false;
    mount.pitch = pitch;
  }
  return put(camera.x, record::kPosition, mount.x) && put(camera.y, record::kPosition, mount.y) &&
         put(camera.z, record::kPosition, mount.z) && put(camera.yaw, record::kHeading, mount.yaw);
}

[[nodiscard]] bool put_optics(const fencepost_camera& camera, sensor::CameraIntrinsics& to) {
  return put(camera.fx, record::kFocalLength, to.fx) && put(camera.fy, record::kFocalLength, to.fy) &&
         put(camera.cx, record::kPrincipalPoint, to.cx) && put(camera.cy, record::kPrincipalPoint, to.cy) &&
         put(camera.k1, record::kDistortion, to.k1);
}

std::int32_t area(const fencepost_box& box) { return (box.right - box.left + 1) * (box.bottom - box.top + 1); }

// Twice the middle, in tenths of a pixel.
base::Pixels1 middle(std::int16_t low, std::int16_t high) { return {5 * (std::int32_t{low} + high)}; }

sensor::Blob blob_of(const fencepost_box& box) {
  sensor::Blob blob;
  blob.signature = box.signature;
  blob.x1 = box.left;
  blob.y1 = box.top;
  blob.x2 = box.right;
  blob.y2 = box.bottom;
  blob.cx = middle(box.left, box.right);
  blob.cy = middle(box.top, box.bottom);
  return blob;
}

}  // namespace

base::Result<sensor::CameraIntrinsics, Answer> intrinsics_of(const fencepost_camera& camera) {
  const auto usable = [](std::uint16_t size) {
    return size >= record::kImageSize.min && size <= record::kImageSize.max;
  };
  sensor::CameraIntrinsics to;
  to.model = "embedded";
  to.width = camera.width;
  to.height = camera.height;
  to.lens = camera.fisheye ? sensor::Lens::kEquidistant : sensor::Lens::kPinhole;
  to.latency = {camera.latency / kMicrosPerTick};
  const bool in_time = camera.latency >= 0 && to.latency.raw <= record::kLatency.max;
  if (!usable(camera.width) || !usable(camera.height) || !in_time) return Answer::kRange;
  if (!put_optics(camera, to) || !put_mount(camera, to.mount)) return Answer::kRange;
  return to;
}

base::Result<record::Signature, Answer> signature_of(const fencepost_colour& colour) {
  constexpr float kPerMetre = 1'000;
  const float width = colour.size * kPerMetre + 0.5F;
  const bool within = colour.size == 0 || (width >= static_cast<float>(record::kWidth.min) &&
                                           width < static_cast<float>(record::kWidth.max + 1));
  if (!within || colour.pad < record::kPad.min || colour.pad > record::kPad.max) return Answer::kRange;
  record::Signature signature{colour.signature, {colour.red, colour.green, colour.blue}, {}};
  if (colour.name != nullptr) signature.name = colour.name;
  signature.width = static_cast<std::uint16_t>(width);
  signature.pad = colour.pad;
  return signature;
}

base::Result<sensor::OdometrySample, Answer> sample_of(base::Time t, const Pose& pose) {
  sensor::OdometrySample sample;
  sample.t = t;
  const bool within = put(pose.x, record::kPosition, sample.x) && put(pose.y, record::kPosition, sample.y) &&
                      put(pose.heading, record::kHeading, sample.heading);
  if (!within) return Answer::kRange;
  return sample;
}

bool are_boxes(std::span<const fencepost_box> boxes) {
  return std::all_of(boxes.begin(), boxes.end(),
                     [](const fencepost_box& box) { return box.left <= box.right && box.top <= box.bottom; });
}

sensor::BlobFrame frame_of(base::Time t, std::uint32_t number, std::span<const fencepost_box> boxes) {
  std::array<const fencepost_box*, kMaxBoxes> largest{};
  std::size_t count = 0;
  for (const fencepost_box& box : boxes) {
    std::size_t place = count;
    while (place > 0 && area(*largest[place - 1]) < area(box)) --place;
    if (place == kMaxBoxes) continue;
    if (count < kMaxBoxes) ++count;
    for (std::size_t i = count - 1; i > place; --i) largest[i] = largest[i - 1];
    largest[place] = &box;
  }
  sensor::BlobFrame frame{t, number, {}};
  for (std::size_t i = 0; i < count; ++i) static_cast<void>(frame.blobs.push_back(blob_of(*largest[i])));
  return frame;
}

base::Result<sensor::Text, Answer> setting_of(std::string_view key, float value) {
  const auto* entry = std::find_if(config::kKeyInfo.begin(), config::kKeyInfo.end(),
                                   [&](const config::KeyInfo& info) { return info.name == key; });
  if (entry == config::kKeyInfo.end()) return Answer::kUnknown;
  if (entry->unit == config::kChoice) return Answer::kRange;
  float scaled = value;
  for (std::int32_t i = 0; i < entry->decimals; ++i) scaled *= 10;
  const bool within =
      scaled >= static_cast<float>(entry->low) - 0.5F && scaled <= static_cast<float>(entry->high) + 0.5F;
  if (!within) return Answer::kRange;
  const auto count = static_cast<std::int32_t>(scaled < 0 ? scaled - 0.5F : scaled + 0.5F);
  std::array<char, record::kMaxDecimal> digits{};
  const std::size_t size = record::write_decimal(count, static_cast<unsigned>(entry->decimals), digits);
  return sensor::Text{std::string_view{digits.data(), size}};
}

Alert alert_of(const record::AlertReport& report, const char* sentence) {
  Alert alert;
  alert.level = static_cast<Level>(report.level);
  static_cast<fencepost_alert&>(alert).level = static_cast<fencepost_level>(report.level);
  alert.object = report.id;
  alert.signature = report.signature;
  alert.distance = report.distance.to_float();
  alert.bearing = report.bearing.to_float();
  alert.contact = report.ttc ? report.ttc->to_float() : -1;
  alert.confidence = report.confidence.to_float();
  alert.time = micros_of(report.t);
  alert.sentence = sentence;
  return alert;
}
static_assert(static_cast<Level>(record::AlertLevel::kStop) == Level::kStop);
static_assert(static_cast<Level>(record::AlertLevel::kBlind) == Level::kBlind);

Way way_of(const record::WayReport::Way& way) {
  return {static_cast<fencepost_motion>(way.motion), way.curvature.to_float(), way.free.to_float(),
          way.speed.to_float(), static_cast<fencepost_way_end>(way.end)};
}

Object object_of(const record::ObjectReport& report) {
  Object object{};
  object.id = report.id;
  object.signature = report.signature;
  object.confirmed = report.state != record::ObjectState::kTentative;
  object.lost = report.state == record::ObjectState::kLost;
  object.views = report.views;
  object.x = report.x.to_float();
  object.y = report.y.to_float();
  object.radius = report.radius.to_float();
  object.z_min = report.z_min.to_float();
  object.z_max = report.z_max.to_float();
  object.distance = report.distance.to_float();
  object.bearing = report.bearing.to_float();
  object.confidence = report.confidence.to_float();
  return object;
}

}  // namespace fencepost::library
