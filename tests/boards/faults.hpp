// Faults that every board has to survive: cables pulled, garbage, silence, lines cut off.
#pragma once

#include <vector>

#include "tests/boards/emulator.hpp"

namespace fencepost::test {

class Bench;
class Line;

/// A minute of full line rate, 115200 baud, in bytes; sent as fast as the emulator takes them.
inline constexpr std::size_t kMinuteOfBytes = 60 * 11'520;
/// Short enough for every run of the tests; the minute is for toolchain/long boards.
inline constexpr std::size_t kFifteenSecondsOfBytes = kMinuteOfBytes / 4;

/// So many bytes of garbage on each of these lines; then the console's line is ended.
void expect_takes_garbage(Bench& bench, std::vector<Line*> lines, std::size_t bytes = kFifteenSecondsOfBytes);

// GoogleTest expectations. In each the robot is stationary before a post. After the fault its alerts come again within
// a second of its own clock, and it was not reset. No turn of its loop took longer than the watchdog allows.
void expect_survives_camera_loss(const BoardUnderTest& board);
/// On all its lines at once.
void expect_survives_garbage(const BoardUnderTest& board, std::size_t bytes = kFifteenSecondsOfBytes);
void expect_survives_odometry_loss(const BoardUnderTest& board);
void expect_survives_blocked_console(const BoardUnderTest& board);
void expect_survives_cut_lines(const BoardUnderTest& board);

/// The image has its camera on a two-wire bus. The emulator's bus takes every start and ends no transfer. The master
/// has to give up each of them, and the loop must not notice.
void expect_survives_hung_camera_bus(const BoardUnderTest& board);

}  // namespace fencepost::test
