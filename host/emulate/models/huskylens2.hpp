// A HuskyLens 2 as its cable sees it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "host/emulate/models/device_model.hpp"

namespace fencepost::emulate {

/// The frames of the vendor's library 1.0: knock, algorithm and results. It sees coloured blobs while the algorithm is
/// that of colours; signatures are ids, with a name. It believes every length, as the library's own reader does: a
/// HuskyLens 1 request makes it swallow the bytes that follow. Its first second is not documented: it is assumed deaf.
class HuskyLens2 final : public DeviceModel {
 public:
  static constexpr base::Duration kDeaf = base::milliseconds(1'000);

  explicit HuskyLens2(base::Time power_on = {}) : power_on_(power_on) {}

  Bytes power_up(base::Time now) override;
  Bytes take(std::uint8_t byte, base::Time now) override;
  Bytes see(const sensor::BlobFrame& frame, base::Time now) override;

  /// How many colours it has learned.
  void teach(int colours) { learned_ = colours; }
  void show(const std::vector<sensor::Blob>& blobs) { blobs_ = blobs; }

 private:
  [[nodiscard]] Bytes answer(std::uint8_t command, std::uint8_t algorithm, std::span<const std::uint8_t> data);
  [[nodiscard]] Bytes results() const;

  base::Time power_on_;
  Bytes received_;
  std::vector<sensor::Blob> blobs_;
  int algorithm_ = 0;
  int learned_ = 1;
};

/// "ask results", "INFO, 2 objects".
std::string describe_huskylens2(bool from_host, std::span<const std::uint8_t> bytes);

}  // namespace fencepost::emulate
