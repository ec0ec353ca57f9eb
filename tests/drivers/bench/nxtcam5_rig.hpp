// An NXTCam v5 on the serial line of its camera, after our protocol notes.
#pragma once

#include <algorithm>

#include "drivers/nxtcam/v5_camera.hpp"
#include "tests/drivers/bench/bench.hpp"
#include "tests/drivers/bench/cable.hpp"

namespace fencepost::test {

/// `answers`: it takes the version's question and tracks when told; else it only sends blobs, from the start.
class NxtCam5 {
 public:
  static constexpr base::Duration kBoot = base::milliseconds(1'500);

  explicit NxtCam5(base::Time power_on) { restart(power_on); }
  void restart(base::Time now) {
    power_on_ = now;
    received_.clear();
    tracking_ = !answers;
  }
  std::vector<std::uint8_t> take(std::uint8_t byte, base::Time now) {
    if (!answers || now - power_on_ < kBoot) return {};
    received_.push_back(byte);
    if (received_[0] != 0x55) received_.clear();
    if (received_.size() == 2 && received_[1] != 0xAA) received_.clear();
    if (received_.size() < 4) return {};
    if (received_[2] > 8) return received_.clear(), std::vector<std::uint8_t>{};
    if (received_.size() < 5U + received_[2]) return {};
    const std::vector<std::uint8_t> message = std::exchange(received_, {});
    const std::vector<std::uint8_t> body(message.begin() + 4, message.end() - 1);
    if (framed(message[3], body) != message) return {};
    if (message[3] == 3 && body == std::vector<std::uint8_t>{'E'}) tracking_ = true;
    return message[3] == 1 ? framed(1, {'5', '.', '0', '1'}) : std::vector<std::uint8_t>{};
  }
  /// One image's blobs.
  std::vector<std::uint8_t> image(const std::vector<sensor::Blob>& blobs, base::Time now) {
    ++count_;
    if (!tracking_ || now - power_on_ < kBoot) return {};
    std::vector<std::uint8_t> bytes;
    for (const sensor::Blob& blob : blobs) {
      const auto part =
          framed(4, {count_, 0, blob.signature, low(blob.x1), low(blob.y1), low(blob.x2 + 1), low(blob.y2 + 1)});
      bytes.insert(bytes.end(), part.begin(), part.end());
    }
    return bytes;
  }
  static std::vector<std::uint8_t> framed(std::uint8_t type, const std::vector<std::uint8_t>& body) {
    std::vector<std::uint8_t> bytes = {0x55, 0xAA, static_cast<std::uint8_t>(body.size()), type};
    bytes.insert(bytes.end(), body.begin(), body.end());
    unsigned sum = 0;
    for (const std::uint8_t byte : bytes) sum += byte;
    bytes.push_back(static_cast<std::uint8_t>(sum & 0xFFU));
    return bytes;
  }

  bool answers = true;

 private:
  static std::uint8_t low(int value) { return static_cast<std::uint8_t>(value); }

  base::Time power_on_;
  std::vector<std::uint8_t> received_;
  bool tracking_ = false;
  std::uint8_t count_ = 0;
};

struct NxtCam5Rig : CameraRig<> {
  using Link = Cable<NxtCam5>;
  static constexpr base::Duration kImage = base::milliseconds(33);

  explicit NxtCam5Rig(const fake::SteppedClock& clock, const Damage& damage = {}, const nxtcam::V5Options& options = {})
      : device(clock.now()), link(device, clock, damage), driver(link, options) {
    link.count_frames([](std::span<const std::uint8_t> bytes) { return bytes[3] == 4; });
  }
  void live(base::Time now) {
    if (expose(now, kImage)) link.inject(device.image(moving ? std::vector{blob_of(images)} : scene, now));
  }
  base::Result<Sample> poll(base::Time now) { return driver.poll(now); }
  void restart(base::Time now) { device.restart(now), link.forget(); }
  static sensor::Blob blob_of(std::int64_t image) {
    const auto x = static_cast<std::int16_t>(image % 190);
    const auto y = static_cast<std::int16_t>(image / 190 % 120);
    return {
        3, x, y, static_cast<std::int16_t>(x + 41), static_cast<std::int16_t>(y + 30), {10 * x + 205}, {10 * y + 150},
        0, {}};
  }
  [[nodiscard]] bool shows(const sensor::BlobFrame& frame, std::int64_t last) const {
    return frame.blobs.size() == 1 && any_of_last(last, [&](auto image) { return frame.blobs[0] == blob_of(image); });
  }
  [[nodiscard]] bool right(const sensor::BlobFrame& frame) const { return shows(frame, latest); }
  [[nodiscard]] bool old(const sensor::BlobFrame& frame) const { return shows(frame, kOldImages); }

  NxtCam5 device;
  Link link;
  nxtcam::V5Camera<Link> driver;
};

}  // namespace fencepost::test
