// Intel HEX, the file of a micro:bit's drive and of many programmers.
#pragma once

#include <string>
#include <string_view>

#include "hal/base/result.hpp"
#include "host/configure/image_file.hpp"

namespace fencepost::host {

/// Records 00, 01, 02 and 04; those of where the program starts (03, 05) are passed over.
/// errors: "line 3: what is wrong"
base::Result<ImageMemory, std::string> read_hex(std::string_view file);
/// The memory's known bytes, 16 a line.
std::string write_hex(const ImageMemory& memory);

}  // namespace fencepost::host
