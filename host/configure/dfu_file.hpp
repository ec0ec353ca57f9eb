// DfuSe, the file that dfu-util and STM32CubeProgrammer send to the boot loader of an STM32.
#pragma once

#include <string>
#include <string_view>

#include "host/configure/image_file.hpp"

namespace fencepost::host {

bool looks_like_dfu(std::string_view file);

/// From the first known byte to the last one; gaps are erased.
std::string write_dfu(const ImageMemory& memory);

}  // namespace fencepost::host
