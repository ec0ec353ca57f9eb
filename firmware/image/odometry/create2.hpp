// FENCEPOST_ODOMETRY=create2: an iRobot Create 2 or Roomba 600 on the board's base line.
#pragma once

#include "firmware/image/create_base.hpp"

namespace fencepost::image {

using Odometry = CreateBase<create::Model::kCreate2, 115'200>;

}  // namespace fencepost::image
