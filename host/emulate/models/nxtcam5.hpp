// An NXTCam v5 on the serial line between its camera and its bridge.
#pragma once

#include <cstdint>
#include <vector>

#include "hal/base/units.hpp"
#include "hal/sensor/blob_frame.hpp"

namespace fencepost::emulate {

/// Frames are `55 AA length type data checksum`. Blobs are sent unasked, one frame each; an image without any sends
/// nothing. Source: the v5 section of our protocol notes; whether a real one takes questions and commands is uncertain.
class NxtCam5 {
 public:
  static constexpr base::Duration kBoot = base::milliseconds(1'500);

  explicit NxtCam5(base::Time power_on) { restart(power_on); }
  void restart(base::Time now);
  /// True: it answers the version's question and tracks on command; false: it only sends blobs, from the start.
  void set_answers(bool answers);

  /// The reply to a byte from the host.
  std::vector<std::uint8_t> take(std::uint8_t byte, base::Time now);
  /// The bytes for one image; blobs in our convention.
  std::vector<std::uint8_t> image(const std::vector<sensor::Blob>& blobs, base::Time now);
  [[nodiscard]] bool tracking() const { return tracking_; }

  /// A whole frame around `body`.
  static std::vector<std::uint8_t> framed(std::uint8_t type, const std::vector<std::uint8_t>& body);

 private:
  std::vector<std::uint8_t> obey(const std::vector<std::uint8_t>& message);

  bool answers_ = true;
  base::Time power_on_;
  std::vector<std::uint8_t> received_;
  bool tracking_ = false;
  std::uint8_t count_ = 0;
};

}  // namespace fencepost::emulate
