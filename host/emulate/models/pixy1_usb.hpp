// A Pixy on USB: blocks pushed in Chirp's messages.
#pragma once

#include <cstdint>
#include <vector>

#include "hal/base/units.hpp"
#include "hal/sensor/blob_frame.hpp"
#include "host/emulate/models/bytes.hpp"

namespace fencepost::emulate {

/// Takes transfers of 64 bytes: INIT, ENUMERATE of `run` and CALL of it. From then on it pushes fifty images a second,
/// each as 64 bytes, padded with junk, and a second transfer if it is longer. Boxes are given by their edges.
class Pixy1Usb {
 public:
  static constexpr base::Duration kStart = base::milliseconds(1'000);
  static constexpr base::Duration kImage = base::milliseconds(20);

  explicit Pixy1Usb(base::Time power_on) { static_cast<void>(power_up(power_on)); }

  Bytes power_up(base::Time now);
  Bytes take(std::uint8_t byte, base::Time now);
  [[nodiscard]] base::Time next() const { return next_image_; }
  Bytes step(base::Time now);
  void show(const std::vector<sensor::Blob>& blobs) { blobs_ = blobs; }
  /// Without colour codes it says CCB1.
  void tell_codes(bool told) { codes_ = told; }

 private:
  [[nodiscard]] Bytes answer(const Bytes& transfer);

  base::Time power_on_;
  base::Time next_image_;
  Bytes received_;
  std::vector<sensor::Blob> blobs_;
  bool initialised_ = false;
  bool hints_ = false;
  bool running_ = false;
  bool codes_ = true;
};

}  // namespace fencepost::emulate
