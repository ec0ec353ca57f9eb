// Hours on a bad cable: one byte in a hundred damaged, both ways, and every 20 s a stall, a reboot or an unplug.
#pragma once

#include <cstdint>

#include "tests/drivers/bench/hostile_cases.hpp"
#include "tests/drivers/bench/hostile_figures.hpp"

namespace fencepost::test {

HostileFigures run_hostile_hours(const HostileCase& driver, double hours, std::uint32_t seed);

}  // namespace fencepost::test
