// A Pixy (CMUcam5) as its cable sees it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <vector>

#include "host/emulate/models/device_model.hpp"

namespace fencepost::emulate {

/// Fifty images a second, each with its blocks by signature, the largest first, at most 100 of them. On a UART two
/// zeros precede an image unless the line is busy. The next image cuts off a list that was not sent in time. Commands
/// (servos, brightness, lamp) have no answer. The real start-up time is not known: a second is assumed.
class Pixy1 final : public DeviceModel {
 public:
  static constexpr base::Duration kStart = base::milliseconds(1'000);
  static constexpr base::Duration kImage = base::milliseconds(20);

  /// `baud` of its UART; 0: as fast as it goes.
  explicit Pixy1(std::uint32_t baud) : baud_(baud) { static_cast<void>(power_up({})); }

  Bytes power_up(base::Time now) override;
  Bytes take(std::uint8_t byte, base::Time now) override;
  Bytes see(const sensor::BlobFrame& frame, base::Time now) override;
  [[nodiscard]] std::optional<base::Time> next() const override;
  Bytes step(base::Time now) override;
  [[nodiscard]] bool in_use() const override { return true; }
  [[nodiscard]] bool talks_unasked() const override { return true; }

  void show(const std::vector<sensor::Blob>& blobs);
  /// A colour code of the next image and those behind it; by its edges. The angle is in degrees.
  struct ColourCode {
    std::uint16_t number = 0;
    int left = 0;
    int right = 0;
    int top = 0;
    int bottom = 0;
    int angle = 0;
  };
  void show_code(const ColourCode& code) { codes_ = {code}; }

  /// Bytes for a two-wire bus: the rest of the image, then zeros; nothing while it starts.
  Bytes pull(std::size_t count, base::Time now);

 private:
  void begin_image();
  [[nodiscard]] bool all_sent() const { return sent_ == list_.size() + codes_.size(); }
  Bytes next_block();
  [[nodiscard]] base::Duration time_of(std::size_t bytes) const;

  std::uint32_t baud_;
  std::vector<sensor::Blob> shown_;
  std::vector<sensor::Blob> list_;
  std::vector<ColourCode> codes_;
  std::size_t sent_ = 0;  ///< of this image
  base::Time next_image_;
  base::Time free_;  ///< when the UART has sent all
  std::deque<std::uint8_t> pulled_;
  std::uint8_t heard_ = 0;  ///< the host's last byte
};

/// "3 blocks", "image of 3 blocks", "nothing".
std::string describe_pixy1(bool from_host, std::span<const std::uint8_t> bytes);

}  // namespace fencepost::emulate
