// Game Boy Advance, the brain of the XBC. Fed by its link, never connected to an XBC's camera: how that camera's gate
// array is reached is not documented. What every board offers: hal/boards/README.md.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "hal/boards/gba/console_link.hpp"
#include "hal/bus/buttons.hpp"
#include "hal/mcu/gba/clock.hpp"
#include "hal/mcu/gba/screen.hpp"
#include "hal/mcu/gba/sram.hpp"
#include "hal/mcu/reset.hpp"

namespace fencepost::board {

inline constexpr std::string_view kTarget = "gba";

using Clock = mcu::gba::Clock;
using Link = ConsoleLink;
using Flash = mcu::gba::Sram;
using Screen = mcu::gba::Screen;

/// Before anything else here: waits of the cartridge, clock, console, screen, memory for settings.
void start(std::uint32_t console_baud);

Clock& clock();
Link& console();
Flash& flash();
Screen& screen();
bus::Buttons buttons();

/// The hardware does not record a reset reason.
inline mcu::ResetReason take_reset_reason() { return mcu::ResetReason::kUnknown; }
/// A fault enters the BIOS, which halts: nothing can be saved.
inline std::optional<mcu::Panic> take_panic() { return std::nullopt; }

/// There is no pin for STOP: who drives listens to the console's heartbeat.
inline void allow_motion(bool /*allowed*/) {}
/// There is no watchdog: a loop that hangs does so until the power is switched off.
inline void feed_watchdog() {}
/// Sleeps until a byte comes or a millisecond is over.
void idle();

}  // namespace fencepost::board
