// A Grove Vision AI V2 as its cable sees it: SSCMA's AT commands, replies and results in JSON.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/emulate/models/device_model.hpp"
#include "host/emulate/models/i2c_device.hpp"

namespace fencepost::emulate {

/// Commands: `ID?`, `NAME?`, `VER?`, `STAT?`, `INVOKE?`, `BREAK`, `INVOKE=times,differed,result_only`, which it obeys
/// without a picture. Any other gets a log reply. Its output while it starts is not documented: it is assumed silent
/// and deaf for a second. Middles of boxes are whole pixels; its scores are 90.
class Grove final : public DeviceModel {
 public:
  static constexpr base::Duration kBoot = base::milliseconds(1'000);

  /// The resolution that its results name.
  explicit Grove(int width = 240, int height = 240, base::Time power_on = {})
      : width_(width), height_(height), power_on_(power_on) {}

  Bytes power_up(base::Time now) override;
  Bytes take(std::uint8_t byte, base::Time now) override;
  Bytes see(const sensor::BlobFrame& frame, base::Time now) override;
  [[nodiscard]] bool awake(base::Time now) const { return now - power_on_ >= kBoot; }

 private:
  [[nodiscard]] std::string obey(const std::string& command);
  [[nodiscard]] std::string invoke(const std::string& arguments);

  int width_;
  int height_;
  base::Time power_on_;
  std::string line_;
  std::int64_t left_ = 0;  ///< results to come; negative: without end
  std::uint32_t results_ = 0;
};

/// The same on I2C: output waits until it is read, in packets of at most 250 bytes.
class GroveOnI2c final : public I2cDevice {
 public:
  explicit GroveOnI2c(Grove& device) : device_(device) {}

  void say(const Bytes& bytes);
  void restart() { waiting_.clear(), asked_ = 0; }
  std::optional<std::vector<std::uint8_t>> transfer(std::uint8_t address, const std::vector<std::uint8_t>& out,
                                                    std::size_t expected, base::Time now) override;

 private:
  Grove& device_;
  Bytes waiting_;
  bool count_asked_ = false;
  std::size_t asked_ = 0;
};

}  // namespace fencepost::emulate
