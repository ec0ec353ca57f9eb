// Functions of fencepost.h that need no core; the C++ header calls them, too.
#include <array>
#include <cmath>
#include <cstdint>

#include "firmware/config/devices.hpp"
#include "firmware/fencepost/convert.hpp"
#include "hal/base/trig.hpp"

namespace {

constexpr std::array<const char*, 7> kAnswers = {
    "taken",
    "the time is not later than the one before",
    "a number is out of range: outside the image, not a number, or one that cannot be",
    "boxes came before a camera was set",
    "there is no setting of this name",
    "there is no room for one more name",
    "a pointer is null",
};
static_assert(kAnswers.size() == FENCEPOST_NULL + 1);
constexpr std::array<const char*, 5> kLevels = {"CLEAR", "NOTICE", "WARN", "STOP", "BLIND"};
static_assert(kLevels.size() == FENCEPOST_BLIND + 1);

/// One dimension of a box: its first pixel and its last.
struct Extent {
  std::int16_t first = 0;
  std::int16_t last = -1;  ///< before the first: no box
};

Extent extent(float middle, float size) {
  constexpr float kFarthest = 16'000;  // px, of a middle: more than any image has
  const bool possible = size >= 0 && size <= kFarthest && middle >= -kFarthest && middle <= kFarthest;
  if (!possible) return {};  // also what is no number
  const float pixels = size < 1 ? 1 : std::floor(size + 0.5F);
  const float first = std::floor(middle - 0.5F * (pixels - 1) + 0.5F);
  return {static_cast<std::int16_t>(first), static_cast<std::int16_t>(first + pixels - 1)};
}

}  // namespace

const char* fencepost_version() { return FENCEPOST_VERSION; }

const char* fencepost_answer_text(fencepost_answer answer) {
  const auto index = static_cast<std::size_t>(answer);
  return index < kAnswers.size() ? kAnswers[index] : "no such answer";
}

const char* fencepost_level_text(fencepost_level level) {
  const auto index = static_cast<std::size_t>(level);
  return index < kLevels.size() ? kLevels[index] : "?";
}

fencepost_camera fencepost_delivered_camera(const char* name) {
  using namespace fencepost;
  fencepost_camera camera{};
  const config::CameraId id = config::camera_named(name == nullptr ? "" : name);
  if (static_cast<std::size_t>(id) >= config::kCameraIds) return camera;
  const sensor::CameraIntrinsics delivered = config::delivered_calibration(id);
  camera.width = delivered.width;
  camera.height = delivered.height;
  camera.fx = delivered.fx.to_float();
  camera.fy = delivered.fy.to_float();
  camera.cx = delivered.cx.to_float();
  camera.cy = delivered.cy.to_float();
  camera.k1 = delivered.k1.to_float();
  camera.fisheye = delivered.lens == sensor::Lens::kEquidistant;
  camera.latency = static_cast<std::int32_t>(delivered.latency.raw * library::kMicrosPerTick);
  return camera;
}

fencepost_camera fencepost_pinhole(std::uint16_t width, std::uint16_t height, float degrees) {
  constexpr float kHalfDegree = 8726.6463F;  // urad: pi / 360
  fencepost_camera camera{};
  const bool possible = degrees >= 1 && degrees <= 170;
  if (!possible) return camera;
  const fencepost::base::SinCos half = fencepost::base::sincos_urad(static_cast<std::int64_t>(degrees * kHalfDegree));
  camera.width = width;
  camera.height = height;
  camera.fx = camera.fy = 0.5F * static_cast<float>(width) * half.cos / half.sin;
  camera.cx = 0.5F * static_cast<float>(width - 1);
  camera.cy = 0.5F * static_cast<float>(height - 1);
  return camera;
}

fencepost_box fencepost_box_centred(std::uint8_t signature, float cx, float cy, float width, float height) {
  const Extent columns = extent(cx, width);
  const Extent rows = extent(cy, height);
  return {signature, columns.first, rows.first, columns.last, rows.last};
}
