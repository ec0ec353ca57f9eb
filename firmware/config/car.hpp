// The settings of a car as its odometry takes them.
#pragma once

#include <string_view>

#include "drivers/odometry/car_drive.hpp"
#include "firmware/config/settings.hpp"

namespace fencepost::config {

odometry::CarGeometry car_of(const Settings& settings);

/// What is wrong, and what to do.
std::string_view reason(odometry::CarProblem problem);

}  // namespace fencepost::config
