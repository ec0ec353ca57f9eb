// One transfer of libusb with its buffer. It stays where it is while the kernel has it.
#pragma once

#include <libusb-1.0/libusb.h>

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "hal/base/check.hpp"

namespace fencepost::linux {

class UsbTransfer {
 public:
  using Done = std::function<void(UsbTransfer&)>;

  /// `done` is called from within libusb's event handling.
  explicit UsbTransfer(Done done) : transfer_(libusb_alloc_transfer(0)), done_(std::move(done)) {
    FENCEPOST_CHECK(transfer_ != nullptr);
  }
  /// Only when it is not in flight.
  ~UsbTransfer() { libusb_free_transfer(transfer_); }
  UsbTransfer(const UsbTransfer&) = delete;
  UsbTransfer& operator=(const UsbTransfer&) = delete;

  /// 0, or an error of libusb. timeout: ms, 0: none.
  int submit(libusb_device_handle* device, unsigned char endpoint, std::vector<std::uint8_t> bytes, unsigned timeout) {
    bytes_ = std::move(bytes);
    libusb_fill_bulk_transfer(transfer_, device, endpoint, bytes_.data(), static_cast<int>(bytes_.size()), &on_done,
                              this, timeout);
    const int error = libusb_submit_transfer(transfer_);
    in_flight_ = error == 0;
    return error;
  }
  void cancel() {
    if (in_flight_) libusb_cancel_transfer(transfer_);
  }

  [[nodiscard]] bool in_flight() const { return in_flight_; }
  [[nodiscard]] libusb_transfer_status status() const { return transfer_->status; }
  /// The bytes that went over the wire.
  [[nodiscard]] std::span<const std::uint8_t> bytes() const {
    return {bytes_.data(), static_cast<std::size_t>(transfer_->actual_length)};
  }

 private:
  static void LIBUSB_CALL on_done(libusb_transfer* transfer) {
    auto* self = static_cast<UsbTransfer*>(transfer->user_data);
    self->in_flight_ = false;
    self->done_(*self);
  }

  libusb_transfer* transfer_;
  std::vector<std::uint8_t> bytes_;
  bool in_flight_ = false;
  Done done_;
};

}  // namespace fencepost::linux
