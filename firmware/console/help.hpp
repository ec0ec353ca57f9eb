// `help`: every command, one a line, on one screen; `settings`: every setting.
#pragma once

#include <cstddef>
#include <span>

#include "firmware/config/devices.hpp"
#include "firmware/config/settings.hpp"
#include "firmware/console/command.hpp"
#include "firmware/console/sentence.hpp"

namespace fencepost::console {

/// All that `set` changes.
struct SettingsInForce {
  const config::Settings& settings;
  const config::Devices& devices;
  const config::DeviceOffer* offer = nullptr;  ///< none: devices are not chosen here

  /// Lines of a list of them.
  [[nodiscard]] std::size_t lines() const { return config::kKeys + (offer != nullptr ? config::kDeviceKeys : 0); }
};

/// Lines that a terminal of 24 rows shows above the one that is being typed.
inline constexpr std::size_t kScreenLines = 22;
inline constexpr std::size_t kHelpLines = kVerbs + 1;  ///< of `help`: one for each command, and one more
static_assert(kHelpLines <= kScreenLines);

/// `line` < kHelpLines.
std::size_t write_help(std::size_t line, std::span<char> out);

/// One setting, its value, range, unit and meaning; `line` < in_force.lines().
std::size_t write_setting(std::size_t line, const SettingsInForce& in_force, std::span<char> out);

/// "0.00..10.00 m" or "on|off".
void put_range(Sentence& sentence, const config::KeyInfo& entry);
/// The same, or "pixy2|pixy2.1|...": what the image has.
void put_choice(Sentence& sentence, config::DeviceKey key, const config::DeviceLimits& limits);

}  // namespace fencepost::console
