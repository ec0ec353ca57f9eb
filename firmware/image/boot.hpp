// The lines that a board prints when it starts; to a reader of the stream they are foreign.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "hal/mcu/reset.hpp"

namespace fencepost::image {

struct BootFacts {
  std::string_view version;
  std::string_view target;
  std::string_view profile;
  mcu::ResetReason reason = mcu::ResetReason::kUnknown;
  std::optional<mcu::Panic> panic;
};

inline constexpr std::string_view kProduct = "fencepost";
/// Version, reason of the reset, panic, READY.
inline constexpr std::size_t kBootLines = 4;
/// Line n; its length with the line end, or 0 if it does not fit.
std::size_t write_boot_line(std::size_t n, const BootFacts& facts, std::span<char> out);

}  // namespace fencepost::image
