// A device on a board's USB host, or anything else that has whole telegrams.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/base/result.hpp"
#include "hal/bus/packet_link.hpp"

namespace fencepost::port {

class UsbHost {
 public:
  /// Fill in: hand the whole telegram to the OUT endpoint, or kFull while the last one is on its way.
  base::Result<std::size_t> send(std::span<const std::uint8_t> out) {
    static_cast<void>(out);
    return base::Error::kGone;
  }
  /// Fill in: the telegram of the IN endpoint that came last, then ask for the next. kBadInput: longer than `in`.
  /// Clear a halted endpoint here; kGone until a device with the right ids has been enumerated.
  base::Result<std::size_t> receive(std::span<std::uint8_t> in) {
    static_cast<void>(in);
    return base::Error::kGone;
  }
};

static_assert(bus::PacketLink<UsbHost>);

}  // namespace fencepost::port
