// UF2, the file of the drive that an RP2040 or an RP2350 shows.
#pragma once

#include <string>
#include <string_view>

#include "hal/base/result.hpp"
#include "host/configure/image_file.hpp"

namespace fencepost::host {

bool looks_like_uf2(std::string_view file);

/// errors: a damaged block, another part's file
base::Result<ImageMemory, std::string> read_uf2(std::string_view file);
/// Blocks of 256 bytes, of those with anything known; for the part whose boot ROM would start it.
std::string write_uf2(const ImageMemory& memory);

}  // namespace fencepost::host
