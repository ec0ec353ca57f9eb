#include "host/emulate/models/camera_adapters.hpp"
#include "host/emulate/models/bytes.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "host/emulate/models/nxtcam.hpp"
#include "host/emulate/models/nxtcam5.hpp"
#include "host/emulate/models/pixy2.hpp"
#include "host/emulate/models/xbc.hpp"

namespace fencepost::emulate {
namespace {

std::string text_of(std::uint8_t byte) { return {static_cast<char>(byte)}; }
std::vector<sensor::Blob> list_of(const sensor::BlobFrame& frame) { return {frame.blobs.begin(), frame.blobs.end()}; }

class Pixy2Adapter final : public DeviceModel {
 public:
  Bytes power_up(base::Time now) override {
    camera_.restart(now);
    return {};
  }
  Bytes take(std::uint8_t byte, base::Time now) override { return camera_.take(byte, now); }
  Bytes see(const sensor::BlobFrame& frame, base::Time) override {
    camera_.see(list_of(frame));
    return {};
  }
  [[nodiscard]] bool in_use() const override { return camera_.asked(); }
  [[nodiscard]] std::vector<std::string> not_emulated() const override { return camera_.not_emulated(); }

 private:
  Pixy2 camera_{base::Time{}};
};

class CmuCamAdapter final : public DeviceModel {
 public:
  CmuCamAdapter(CmuCamModel model, Colours colours)
      : camera_(model), full_range_(model == CmuCamModel::kFour), colours_(std::move(colours)) {}

  Bytes power_up(base::Time now) override {
    next_image_ = now + kLongestPause;
    Bytes said = bytes_of(camera_.power_up());
    started_ = now + CmuCamDevice::kStart;
    return said;
  }
  Bytes take(std::uint8_t byte, base::Time now) override {
    const bool before = camera_.starting();
    Bytes reply = bytes_of(camera_.feed({text_of(byte)}));
    if (camera_.starting() && !before) started_ = now + CmuCamDevice::kStart;
    used_ = used_ || camera_.tracking();
    return reply;
  }
  Bytes see(const sensor::BlobFrame& frame, base::Time now) override {
    spots_.clear();
    for (const sensor::Blob& blob : frame.blobs) spots_.push_back(spot_of(blob));
    return step(now);
  }
  [[nodiscard]] std::optional<base::Time> next() const override {
    return camera_.starting() ? std::min(next_image_, started_) : next_image_;
  }
  Bytes step(base::Time now) override {
    if (camera_.starting() && now >= started_) return bytes_of(camera_.finish_start());
    next_image_ = now + kLongestPause;
    return bytes_of(camera_.frame(spots_));
  }
  [[nodiscard]] std::uint32_t baud() const override { return camera_.baud(); }
  [[nodiscard]] std::vector<std::string> not_emulated() const override { return camera_.not_emulated(); }

 private:
  // A real one streams continuously, and its hosts rely on that: where the feed is slow, or has not begun, it repeats
  // the last image.
  static constexpr base::Duration kLongestPause = base::milliseconds(150);

  // 16 to 240 is what the older imagers give.
  [[nodiscard]] int level(std::uint8_t value) const { return full_range_ ? value : std::clamp<int>(value, 16, 240); }

  [[nodiscard]] ColouredSpot spot_of(const sensor::Blob& blob) const {
    constexpr sensor::Rgb kGrey{128, 128, 128};
    const sensor::Rgb rgb = blob.rgb ? *blob.rgb : colours_(blob.signature).value_or(kGrey);
    return {level(rgb.red), level(rgb.green), level(rgb.blue), blob.x1,
            blob.y1,        blob.x2,          blob.y2,         static_cast<int>(blob.pixels)};
  }

  CmuCamDevice camera_;
  bool full_range_;
  base::Time started_;  ///< when a start is over
  Colours colours_;
  std::vector<ColouredSpot> spots_;
  base::Time next_image_;
};

class XbcAdapter final : public DeviceModel {
 public:
  Bytes power_up(base::Time) override { return bytes_of(camera_.power_up()); }
  Bytes take(std::uint8_t byte, base::Time) override { return bytes_of(camera_.feed({text_of(byte)})); }
  Bytes see(const sensor::BlobFrame& frame, base::Time) override {
    std::vector<XbcBlob> blobs;
    std::array<int, 3> counts{};
    for (const sensor::Blob& blob : frame.blobs) {
      const int channel = blob.signature - 1;
      blobs.push_back(blob_of(blob, channel, counts.at(static_cast<std::size_t>(channel))++));
    }
    return bytes_of(camera_.frame(blobs));
  }
  [[nodiscard]] bool in_use() const override { return true; }
  [[nodiscard]] bool talks_unasked() const override { return true; }

 private:
  static XbcBlob blob_of(const sensor::Blob& blob, int channel, int index) {
    constexpr int kLargestInt = 32'767;
    const int size = std::min(static_cast<int>(blob.pixels), kLargestInt);
    return {channel, index, (blob.x1 + blob.x2) / 2, (blob.y1 + blob.y2) / 2, size, blob.x1, blob.y1, blob.x2,
            blob.y2, 0};
  }

  XbcDevice camera_;
};

class NxtCamAdapter final : public DeviceModel {
 public:
  NxtCamAdapter() { camera_.teach(0xFF); }

  Bytes power_up(base::Time now) override {
    camera_.restart(now);
    return {};
  }
  Bytes take(std::uint8_t byte, base::Time now) override {
    Bytes reply = camera_.take(byte, now);
    used_ = used_ || camera_.tracking();
    return reply;
  }
  Bytes see(const sensor::BlobFrame& frame, base::Time) override {
    camera_.show(list_of(frame));
    return camera_.packet();
  }
  [[nodiscard]] std::vector<std::string> not_emulated() const override { return camera_.not_emulated(); }

 private:
  NxtCam camera_{base::Time{}};
};

class NxtCam5Adapter final : public DeviceModel {
 public:
  Bytes power_up(base::Time now) override {
    camera_.restart(now);
    next_image_ = now + kLongestPause;
    return {};
  }
  Bytes take(std::uint8_t byte, base::Time now) override {
    Bytes reply = camera_.take(byte, now);
    used_ = used_ || camera_.tracking();
    return reply;
  }
  Bytes see(const sensor::BlobFrame& frame, base::Time now) override {
    shown_ = list_of(frame);
    return step(now);
  }
  [[nodiscard]] std::optional<base::Time> next() const override { return next_image_; }
  Bytes step(base::Time now) override {
    next_image_ = now + kLongestPause;
    return camera_.image(shown_, now);
  }

 private:
  // A real one streams continuously: without a blob for a tenth of a second its hosts conclude that it sees none.
  static constexpr base::Duration kLongestPause = base::milliseconds(90);

  std::vector<sensor::Blob> shown_;
  base::Time next_image_;
  NxtCam5 camera_{base::Time{}};
};

}  // namespace

std::unique_ptr<DeviceModel> make_pixy2_model() { return std::make_unique<Pixy2Adapter>(); }
std::unique_ptr<DeviceModel> make_cmucam_model(CmuCamModel model, Colours colours) {
  return std::make_unique<CmuCamAdapter>(model, std::move(colours));
}
std::unique_ptr<DeviceModel> make_xbc_model() { return std::make_unique<XbcAdapter>(); }
std::unique_ptr<DeviceModel> make_nxtcam_model() { return std::make_unique<NxtCamAdapter>(); }
std::unique_ptr<DeviceModel> make_nxtcam5_model() { return std::make_unique<NxtCam5Adapter>(); }

}  // namespace fencepost::emulate
