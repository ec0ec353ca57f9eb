// The interface definitions of the ROS 2 messages that we write, with those they are made of, as MCAP's "ros2msg" holds
// them. Humble and later; vision_msgs 4.
#pragma once

#include <string>
#include <string_view>

namespace fencepost::host::exports {

/// Definition of a type such as "nav_msgs/msg/Odometry". errors: std::out_of_range: a type that is not among ours
std::string ros2_definition(std::string_view type);

}  // namespace fencepost::host::exports
