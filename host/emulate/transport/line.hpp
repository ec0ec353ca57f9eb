// A cable between a device and its host: as fast as its baud rate, as bad as asked.
#pragma once

#include <deque>
#include <optional>
#include <span>

#include "hal/base/units.hpp"
#include "host/emulate/models/bytes.hpp"
#include "host/emulate/transport/faults.hpp"

namespace fencepost::emulate {

struct LineSettings {
  std::uint32_t baud = 0;  ///< 8N1, ten bit times a byte; 0: as fast as it goes
  /// Bytes that are lost or damaged as one. More than one: frames with a checksum of their own, which the receiver
  /// throws away when damaged.
  std::size_t unit = 1;
  FaultSettings faults;
  std::uint64_t seed = 1;
};

/// Bytes keep their order in each direction.
class Line {
 public:
  explicit Line(const LineSettings& settings);

  /// The device says something at `now`.
  void say(std::span<const std::uint8_t> bytes, base::Time now);
  /// Bytes that have reached the host by `now`, each once.
  Bytes to_host(base::Time now);

  /// The host has sent these.
  void send(std::span<const std::uint8_t> bytes, base::Time now);
  /// Bytes that have reached the device by `now`, each once.
  Bytes to_device(base::Time now);

  /// When the next byte arrives there.
  [[nodiscard]] std::optional<base::Time> next_to_host() const { return next(to_host_); }
  [[nodiscard]] std::optional<base::Time> next_to_device() const { return next(to_device_); }
  /// Nothing is on its way to the host.
  [[nodiscard]] bool idle() const { return to_host_.empty(); }
  /// The line is full: a sender has to wait.
  [[nodiscard]] bool full() const { return to_host_.size() + to_device_.size() >= kMaxOnItsWay; }
  /// From now on; 0: as fast as it goes.
  void set_baud(std::uint32_t baud);
  /// Discards all bytes on their way.
  void clear();

  [[nodiscard]] const FaultCounts& counts() const { return counts_; }
  FaultCounts& counts() { return counts_; }

 private:
  static constexpr std::size_t kMaxOnItsWay = 64 * 1024;

  struct Item {
    std::int64_t arrives_ns = 0;
    std::uint8_t byte = 0;
  };
  void damage_unit(std::span<const std::uint8_t> unit, std::int64_t arrives_ns);
  static std::optional<base::Time> next(const std::deque<Item>& queue);
  static Bytes arrived(std::deque<Item>& queue, base::Time now);

  LineSettings settings_;
  std::int64_t byte_ns_;
  std::int64_t free_ns_ = 0;     ///< when the last byte to the host is out
  std::int64_t stalled_ns_ = 0;  ///< until then nothing moves
  std::deque<Item> to_host_;
  std::deque<Item> to_device_;
  Dice out_;
  Dice in_;
  Dice moods_;
  FaultCounts counts_;
};

}  // namespace fencepost::emulate
