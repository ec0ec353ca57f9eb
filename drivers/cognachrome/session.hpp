// The conversation with a Cognachrome: it listens, and where nothing comes it makes it send.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "drivers/cognachrome/decoder.hpp"
#include "drivers/serial/outbox.hpp"
#include "hal/sensor/camera.hpp"
#include "hal/sensor/link_state.hpp"

namespace fencepost::cognachrome {

/// No source states a field of view, and the lens is that of any video camera. 45 degrees across and an image of 4 by 3
/// are assumed. fx = 125 / tan 22.5 deg, fy = fx 16 / 15. Latency: two fields of 60 /s. Calibrate.
inline constexpr sensor::CameraIntrinsics kProfile = {
    "cognachrome", kWidth, kHeight, {30'178}, {32'190}, {12'450}, {9'950}, {0}, {}, base::milliseconds(33)};

struct Config {
  const Format* format = &kBinary;
};

/// After half a second without a frame, a camera with known strings is stopped, given its strings and started again.
/// Each prompt is awaited for 300 ms; then the sequence begins anew at once. The first frame after a pause is not
/// given: it may be noise.
class Session {
 public:
  using Sample = sensor::BlobFrame;

  explicit Session(const Config& config) : format_(*config.format), decoder_(*config.format) {}

  bool take(std::uint8_t byte, base::Time now);
  [[nodiscard]] const sensor::BlobFrame& sample() const { return decoder_.frame(); }
  void step(base::Time now);
  void link_lost();
  auto& outbox() { return outbox_; }

  /// kUnready: it says something, but for half a second no frame has come, or just one.
  [[nodiscard]] sensor::LinkState link() const;
  [[nodiscard]] std::uint32_t dropped() const { return decoder_.counts().blobs_dropped; }
  [[nodiscard]] const Counts& counts() const { return decoder_.counts(); }

 private:
  static constexpr std::size_t kTail = 7;

  void follow_prompt(std::uint8_t byte, base::Time now);
  void say(std::string_view first, std::string_view then, base::Time now);
  void listen(base::Time now);

  const Format& format_;
  Decoder decoder_;
  serial::Outbox<24> outbox_;
  std::array<char, kTail> tail_{};  ///< the last characters
  std::uint8_t asked_ = 0;          ///< prompts that were asked for; 0: it only listens
  std::optional<base::Time> byte_at_;
  std::optional<base::Time> frame_at_;
  bool steady_ = false;                 ///< the last frame came soon after one
  std::optional<base::Time> deadline_;  ///< of the prompt, or of the next try
};

}  // namespace fencepost::cognachrome
