// A log as a robot's two sensors and its console: one record at a time, so stream order is kept.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "hal/bus/byte_link.hpp"
#include "hal/sensor/sources.hpp"

namespace fencepost::host {

/// Returns the offered item, once.
template <class Item>
class OfferedOnce {
 public:
  void offer(const Item& item) { item_ = item; }

  base::Result<Item> poll(base::Time /*now*/) {
    if (!item_) return base::Error::kNotReady;
    const Item item = *item_;
    item_.reset();
    return item;
  }
  [[nodiscard]] sensor::LinkState link() const { return sensor::LinkState::kOk; }
  [[nodiscard]] std::uint32_t dropped() const { return 0; }
  [[nodiscard]] static bool stamped_here() { return false; }

 private:
  std::optional<Item> item_;
};

using LogCamera = OfferedOnce<sensor::BlobFrame>;
using LogOdometry = OfferedOnce<sensor::OdometrySample>;
static_assert(sensor::BlobCamera<LogCamera>);
static_assert(sensor::OdometrySource<LogOdometry>);

/// A console without input or reader: the log of a replay is its journal.
class NoConsole {
 public:
  static base::Result<std::size_t> read(std::span<std::uint8_t> /*buffer*/) { return base::Error::kNotReady; }
  static base::Result<std::size_t> write(std::span<const std::uint8_t> bytes) { return bytes.size(); }
};
static_assert(bus::ByteLink<NoConsole>);

}  // namespace fencepost::host
