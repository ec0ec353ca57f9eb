// Shared by listening to a CAN interface and sending on it.
#pragma once

#include <string>
#include <string_view>

#include "hal/linux/descriptor.hpp"
#include "hal/linux/opened.hpp"

namespace fencepost::linux {

/// A raw socket, not bound yet; what it shall let through is set before it is. errors: errno in `error`
Descriptor make_can_socket(int& error);

/// 0, or the error. bind() takes an interface that is down, and would then receive nothing: that is ENETDOWN here.
int bind_can_if_up(int fd, const std::string& interface);

/// "cannot WHAT can0: the reason; what to try".
Problem can_problem(std::string_view what, const std::string& interface, int error);

}  // namespace fencepost::linux
