// A device of host/emulate and its cable in memory, which faults come and go on.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>

#include "host/emulate/models/i2c_device.hpp"
#include "host/emulate/scene/endpoint.hpp"
#include "tests/studies/storm/chance.hpp"

namespace fencepost::test {

/// A two-wire bus's clock, and what its adapter does when the bus hangs: gives up, or waits.
struct Wires {
  std::uint32_t hertz = 400'000;
  bool gives_up = true;
};

/// The outcome of a transfer on it.
struct Transferred {
  std::optional<emulate::Bytes> in;  ///< nothing: not acknowledged
  base::Duration stretched;          ///< how long the device held the clock
};

/// All times are the world's, which no power cut of the robot sets back.
class FarEnd {
 public:
  FarEnd(const emulate::EmulatedDevice& device, const emulate::Colours& colours,
         const std::optional<sensor::CameraIntrinsics>& of_boxes, std::uint64_t seed, base::Time now);

  // The world.
  void see(const sensor::BlobFrame& frame, base::Time now);
  void pose(const sensor::OdometrySample& sample, base::Time now);
  /// Up to `now`.
  void step(const emulate::Travel& travel, base::Time now);

  /// Without its cable it has no power: on USB.
  void live_on_cable() { lives_on_cable_ = true; }

  // Faults.
  void set_noise(double probability) { noise_ = probability; }
  void set_stalled(bool stalled) { stalled_ = stalled; }
  /// It sees nothing new.
  void set_frozen(bool frozen) { frozen_ = frozen; }
  void set_plugged(bool plugged);
  /// Switched off, it says nothing and forgets what was on its way.
  void set_power(bool on, base::Time now);
  /// Bytes that it did not say; of a bus, in whole frames.
  void inject(std::uint64_t count, std::uint64_t seed);

  // The robot's end.
  [[nodiscard]] bool plugged() const { return plugged_; }
  [[nodiscard]] bool stalled() const { return stalled_; }
  std::size_t read(std::span<std::uint8_t> in);
  void write(std::span<const std::uint8_t> out);
  /// On a two-wire bus; noise is a byte that is not acknowledged, a short read, a held clock.
  Transferred transfer(std::uint8_t address, std::span<const std::uint8_t> out, std::size_t expected);
  [[nodiscard]] bool powered() const { return powered_; }
  [[nodiscard]] base::Time now() const { return now_; }

  Wires wires;

 private:
  struct Item {
    std::int64_t arrives = 0;  ///< ns
    std::uint8_t byte = 0;
  };
  void say(const emulate::Bytes& bytes, base::Time now);
  void say_unit(std::span<const std::uint8_t> unit);
  bool damages(std::uint8_t& byte);
  [[nodiscard]] std::int64_t now_ns() const { return now_.raw * 100'000; }

  static constexpr std::size_t kPortBuffer = 4'096;  ///< bytes that a kernel keeps for a port: 256 frames of CAN

  emulate::EmulatedDevice device_;
  std::unique_ptr<emulate::DeviceModel> model_;
  emulate::I2cDevice* on_wires_ = nullptr;  ///< the same, where it is on a bus
  std::optional<emulate::ImageFit> fit_;
  sensor::BlobFrame latest_;  ///< image
  base::Duration frame_period_;
  std::optional<base::Time> next_frame_;
  Chance chance_;
  base::Time now_;
  std::int64_t byte_ns_ = 0;
  std::int64_t free_ns_ = 0;  ///< when the last byte to the robot is out
  double noise_ = 0;
  bool stalled_ = false;
  bool frozen_ = false;
  bool plugged_ = true;
  bool powered_ = true;
  bool lives_on_cable_ = false;
  std::deque<Item> to_robot_;
  std::deque<Item> to_device_;
};

}  // namespace fencepost::test
