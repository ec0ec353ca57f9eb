// A camera that delivers whole pictures, as a blob camera.
#pragma once

#include <array>
#include <optional>

#include "drivers/segmenter/blob_finder.hpp"
#include "drivers/segmenter/colour_table.hpp"
#include "hal/bus/picture_source.hpp"
#include "hal/sensor/camera.hpp"
#include "hal/sensor/link_state.hpp"
#include "hal/sensor/sources.hpp"

namespace fencepost::segmenter {

inline constexpr std::uint16_t kWidth = 320;
inline constexpr std::uint16_t kHeight = 240;

/// No webcam says what its lens sees: 60 degrees across are assumed, fx = 160 / tan 30 deg. Calibrate. The latency is
/// assumed too: one and a half pictures of 30 /s.
inline constexpr sensor::CameraIntrinsics kProfile = {"webcam", kWidth,   kHeight, {27'713}, {27'713},
                                                      {15'950}, {11'950}, {0},     {},       base::milliseconds(50)};

/// The same lens, 60 degrees along the longer side.
constexpr sensor::CameraIntrinsics profile_of(std::uint16_t width, std::uint16_t height) {
  sensor::CameraIntrinsics profile = kProfile;
  const std::int32_t longer = width > height ? width : height;
  profile.fx = profile.fy = {kProfile.fx.raw * longer / kWidth};
  profile.width = width;
  profile.height = height;
  profile.cx = {(width - 1) * base::Pixels2::kPerUnit / 2};
  profile.cy = {(height - 1) * base::Pixels2::kPerUnit / 2};
  return profile;
}

/// Noise is a share of a picture, and a glint's gap one of its width.
constexpr BlobRules rules_of(std::uint16_t width, std::uint16_t height) {
  BlobRules rules;
  rules.min_pixels = rules.min_pixels * width * height / (kWidth * kHeight);
  rules.max_gap = static_cast<std::uint16_t>(rules.max_gap * width / kWidth);
  return rules;
}

inline constexpr std::size_t kMaxRanges = 16;

struct Config {
  base::FixedVector<ColourRange, kMaxRanges> ranges;
  BlobRules rules;
};

/// The boxes of a picture. 175 KB in all, none of it on the heap.
class Segmenter {
 public:
  explicit Segmenter(const Config& config) : config_(config), finder_(config.rules) {}

  /// errors: kBadInput: larger than a BlobFinder takes, or fewer bytes than its size says
  base::Result<sensor::BlobFrame> segment(const bus::Picture& picture) {
    const std::size_t size = row_bytes(picture.layout, picture.width);
    if (picture.width == 0 || picture.width > BlobFinder::kMaxWidth) return base::Error::kBadInput;
    if (picture.height == 0 || picture.height > BlobFinder::kMaxHeight) return base::Error::kBadInput;
    if (picture.stride < size || picture.bytes.size() < (picture.height - 1U) * picture.stride + size) {
      return base::Error::kBadInput;
    }
    if (!filled_ || table_.layout() != picture.layout) table_.fill(picture.layout, config_.ranges.view());
    filled_ = true;
    finder_.begin();
    const std::span<std::uint8_t> labels(labels_.data(), picture.width);
    for (std::size_t v = 0; v < picture.height; ++v) {
      table_.look_up(picture.bytes.subspan(v * picture.stride, size), labels);
      finder_.add_row(labels);
    }
    sensor::BlobFrame frame = finder_.finish();
    frame.t = picture.t;
    frame.frame = frames_++;
    return frame;
  }
  [[nodiscard]] std::uint32_t dropped() const { return finder_.dropped(); }
  [[nodiscard]] bool trained() const { return !config_.ranges.empty(); }

 private:
  Config config_;
  ColourTable table_;
  bool filled_ = false;
  BlobFinder finder_;
  std::array<std::uint8_t, BlobFinder::kMaxWidth> labels_{};
  std::uint32_t frames_ = 0;
};

template <bus::PictureSource Source>
class Camera {
 public:
  Camera(Source& source, const Config& config) : source_(source), segmenter_(config) {}

  base::Result<sensor::BlobFrame> poll(base::Time now) {
    now_ = now;
    const base::Result<bus::Picture> picture = source_.next();
    if (!picture) return without_picture(picture.error());
    const base::Result<sensor::BlobFrame> frame = segmenter_.segment(*picture);
    if (!frame) return without_picture(frame.error());
    heard_ = now;
    state_ = !segmenter_.trained()  ? sensor::LinkState::kUnready
             : frame->blobs.empty() ? sensor::LinkState::kEmpty
                                    : sensor::LinkState::kOk;
    return frame;
  }
  /// unready: no colours, or pictures that cannot be decoded.
  [[nodiscard]] sensor::LinkState link() const {
    return heard_ && now_ - *heard_ < kQuiet ? state_ : sensor::LinkState::kSilent;
  }
  [[nodiscard]] std::uint32_t dropped() const { return segmenter_.dropped(); }

 private:
  /// Without a picture for so long it is silent.
  static constexpr base::Duration kQuiet = base::milliseconds(1'000);

  base::Error without_picture(base::Error error) {
    if (error == base::Error::kGone) heard_.reset();
    if (error == base::Error::kBadInput) {
      heard_ = now_;
      state_ = sensor::LinkState::kUnready;
    }
    return error;
  }

  Source& source_;
  Segmenter segmenter_;
  base::Time now_;
  std::optional<base::Time> heard_;
  sensor::LinkState state_ = sensor::LinkState::kSilent;
};

}  // namespace fencepost::segmenter
