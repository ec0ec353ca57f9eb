// The settings of a car as its odometry takes them.
#pragma once

#include <string_view>

#include "drivers/odometry/car_drive.hpp"
#include "firmware/config/settings.hpp"

namespace fencepost::config {

odometry::CarGeometry car_of(const Settings& settings);

/// The message for a problem: its cause and its remedy.
std::string_view reason(odometry::CarProblem problem);

}  // namespace fencepost::config
