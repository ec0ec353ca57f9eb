// Frames of a CAN bus (ISO 11898-1, classic: at most eight bytes).
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <optional>
#include <span>

#include "hal/base/result.hpp"
#include "hal/base/units.hpp"

namespace fencepost::bus {

struct CanFrame {
  std::uint32_t id = 0;  ///< 11 bits, or 29 if extended
  bool extended = false;
  bool remote = false;
  std::uint8_t length = 0;  ///< of data, 0 to 8
  std::array<std::uint8_t, 8> data{};
  std::optional<base::Time> received;  ///< by the clock of the loop, where the bus knows it

  [[nodiscard]] constexpr std::span<const std::uint8_t> bytes() const { return {data.data(), length}; }
  friend constexpr bool operator==(const CanFrame&, const CanFrame&) = default;
};

/// No call waits. `receive` answers the next frame. kNotReady: none there. kBadInput: the bus reported an error (a
/// frame may be lost). kGone: interface down, controller bus-off or unplugged; later calls may succeed again.
template <class T>
concept CanBus = requires(T bus) {
  { bus.receive() } -> std::same_as<base::Result<CanFrame>>;
};

}  // namespace fencepost::bus
