// Odometry and boxes in, alerts, objects and outlines out: firmware/fencepost/fencepost.hpp says how.
#pragma once

#include "firmware/fencepost/fencepost.hpp"
