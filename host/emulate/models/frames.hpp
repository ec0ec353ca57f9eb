// Speaks as a camera whose own program prints frames as lines of the record stream.
#pragma once

#include <cstdint>

#include "host/emulate/models/device_model.hpp"

namespace fencepost::emulate {

/// $FPFRM by the clock of its own, as the scripts in host/share/examples print it, from two seconds after it was
/// switched on.
class FramePrinter final : public DeviceModel {
 public:
  static constexpr base::Duration kStart = base::milliseconds(2'000);

  /// `areas`: it reports a blob's number of pixels and their mean place; else the box's middle.
  explicit FramePrinter(bool areas) : areas_(areas) {}

  Bytes power_up(base::Time now) override;
  Bytes take(std::uint8_t /*byte*/, base::Time /*now*/) override { return {}; }
  Bytes see(const sensor::BlobFrame& frame, base::Time now) override;
  [[nodiscard]] bool in_use() const override { return true; }
  [[nodiscard]] bool talks_unasked() const override { return true; }

 private:
  bool areas_;
  base::Time power_on_;
  std::uint32_t number_ = 0;
};

}  // namespace fencepost::emulate
