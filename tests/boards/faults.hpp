// What every board has to survive: cables pulled, garbage, silence, lines cut off.
#pragma once

#include "tests/boards/emulator.hpp"

namespace fencepost::test {

/// A minute of full line rate, 115200 baud, in bytes; sent as fast as the emulator takes them.
inline constexpr std::size_t kMinuteOfBytes = 60 * 11'520;

// GoogleTest expectations. In each the robot stands before a post; after the fault its alerts come again within a
// second of its own clock, it was not reset, and no turn of its loop took longer than the watchdog allows.
void expect_survives_camera_loss(const BoardUnderTest& board);
void expect_survives_garbage(const BoardUnderTest& board);  ///< on all its lines at once
void expect_survives_odometry_loss(const BoardUnderTest& board);
void expect_survives_blocked_console(const BoardUnderTest& board);
void expect_survives_cut_lines(const BoardUnderTest& board);

}  // namespace fencepost::test
