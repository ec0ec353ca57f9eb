// FENCEPOST_ODOMETRY=create1: an iRobot Create 1 on the board's base line.
#pragma once

#include "firmware/image/create_base.hpp"

namespace fencepost::image {

using Odometry = CreateBase<create::Model::kCreate1, 57'600>;

}  // namespace fencepost::image
