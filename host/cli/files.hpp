// Reading and writing whole files so that every failure is noticed and said. "-" is standard input or output.
#pragma once

#include <string>
#include <string_view>

namespace fencepost::host::cli {

/// For messages: the path, or "standard input".
std::string input_name(const std::string& path);

/// The bytes of a file. errors: Failure (kUnreadable): missing, directory, not allowed, read error.
std::string read_input(const std::string& path);

/// Writes a file under a temporary name beside it and renames it when it is complete: a full disk never leaves half a
/// file and never destroys an old one. Devices and pipes are written directly. A reader of standard output that
/// stops reading is no error. errors: Failure (kDevice)
void write_output(const std::string& path, std::string_view bytes);

}  // namespace fencepost::host::cli
