// A log as a robot's two sensors and its console: one record at a time, so stream order is kept.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>

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

 private:
  std::optional<Item> item_;
};

using LogCamera = OfferedOnce<sensor::BlobFrame>;
using LogOdometry = OfferedOnce<sensor::OdometrySample>;
static_assert(sensor::BlobCamera<LogCamera>);
static_assert(sensor::OdometrySource<LogOdometry>);

/// Accepts everything at once; never reads.
class ListeningLink {
 public:
  explicit ListeningLink(std::function<void(std::string_view)> hear) : hear_(std::move(hear)) {}

  base::Result<std::size_t> read(std::span<std::uint8_t> /*buffer*/) { return base::Error::kNotReady; }
  base::Result<std::size_t> write(std::span<const std::uint8_t> bytes) {
    hear_({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    return bytes.size();
  }

 private:
  std::function<void(std::string_view)> hear_;
};
static_assert(bus::ByteLink<ListeningLink>);

}  // namespace fencepost::host
