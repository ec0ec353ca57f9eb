// An NXTCam on an I2C bus, of the robot's own computer or behind an NXT brick.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "drivers/nxtcam/session.hpp"
#include "hal/bus/i2c_bus.hpp"
#include "hal/sensor/camera.hpp"
#include "hal/sensor/sources.hpp"

namespace fencepost::nxtcam {

/// The lens is documented nowhere: 43 degrees across, often said of it, gives fx = 88 / tan 21.5 deg; calibrate.
/// Columns and rows have the same pitch. The latency: one frame to track, one until it is read.
inline constexpr sensor::CameraIntrinsics kProfile = {"nxtcam", 176,     144, {22'340}, {22'340},
                                                      {8'750},  {7'150}, {0}, {},       base::milliseconds(50)};

template <bus::I2cBus Bus>
class Camera {
 public:
  explicit Camera(Bus& bus, const Options& options = {}, std::uint8_t address = kDefaultAddress)
      : bus_(bus), address_(address), session_(options) {}

  base::Result<sensor::BlobFrame> poll(base::Time now) {
    if (busy_) finish(now);
    if (!busy_) begin(now);
    if (const sensor::BlobFrame* frame = session_.take_frame()) return *frame;
    return base::Error::kNotReady;
  }
  [[nodiscard]] sensor::LinkState link() const { return session_.link(); }
  [[nodiscard]] std::uint32_t dropped() const { return session_.counters().blobs_dropped; }
  [[nodiscard]] const Session& session() const { return session_; }

 private:
  // Through a brick a transfer takes some 30 ms; the wait for a bus is bounded.
  static constexpr base::Duration kLongestTransfer = base::milliseconds(1'000);

  void begin(base::Time now) {
    if (!waiting_) waiting_ = session_.due(now);
    if (!waiting_) return;
    if (abandoned_) collect_abandoned();
    if (!refused_since_) refused_since_ = now;
    const base::Result<std::size_t> begun = bus_.begin(address_, waiting_->out.view(), waiting_->expected);
    if (begun) {
      busy_ = true;
      begun_ = now;
    } else if (begun.error() != base::Error::kFull || now - *refused_since_ > kLongestTransfer) {
      give_up(begun.error(), now);
    }
  }

  void finish(base::Time now) {
    std::array<std::uint8_t, kMaxRead> in{};
    const base::Result<std::size_t> got = bus_.finish(in);
    if (!got && got.error() == base::Error::kNotReady && now - begun_ <= kLongestTransfer) return;
    if (!got) {
      abandoned_ = got.error() == base::Error::kNotReady;
      return give_up(got.error(), now);
    }
    end_transfer();
    // All bytes of a transfer arrive at once, at its end.
    session_.take(std::span<const std::uint8_t>(in).first(*got), now);
  }

  // The bus stays busy until the result is collected.
  void collect_abandoned() {
    std::array<std::uint8_t, kMaxRead> in{};
    const base::Result<std::size_t> got = bus_.finish(in);
    abandoned_ = !got && got.error() == base::Error::kNotReady;
  }

  void give_up(base::Error error, base::Time now) {
    end_transfer();
    session_.fail(error, now);
  }

  void end_transfer() {
    busy_ = false;
    waiting_.reset();
    refused_since_.reset();
  }

  Bus& bus_;
  std::uint8_t address_;
  Session session_;
  std::optional<Transfer> waiting_;  ///< the transfer that is under way, or that the bus had no room for
  std::optional<base::Time> refused_since_;
  bool busy_ = false;
  bool abandoned_ = false;
  base::Time begun_;
};

}  // namespace fencepost::nxtcam
