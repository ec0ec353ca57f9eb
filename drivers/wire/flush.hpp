// One request on its way out over a byte link.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "drivers/serial/outbox.hpp"
#include "hal/base/check.hpp"
#include "hal/bus/byte_link.hpp"

namespace fencepost::wire {

/// A new request instead of what was not yet sent of the last one; it fits.
template <std::size_t Capacity>
void replace(serial::Outbox<Capacity>& outbox, std::span<const std::uint8_t> request) {
  outbox.clear();
  FENCEPOST_CHECK(outbox.put(request));
}

/// Sends what the link takes now. False: the link is gone.
template <bus::ByteLink Link, std::size_t Capacity>
bool flush(serial::Outbox<Capacity>& outbox, Link& link) {
  if (outbox.waiting().empty()) return true;
  const base::Result<std::size_t> taken = link.write(outbox.waiting());
  if (taken) outbox.sent(*taken);
  return taken || taken.error() != base::Error::kGone;
}

}  // namespace fencepost::wire
