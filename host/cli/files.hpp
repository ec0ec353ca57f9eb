// Reads and writes whole files and reports every failure. "-" is standard input or output.
#pragma once

#include <string>
#include <string_view>

namespace fencepost::host::cli {

/// For messages: the path, or "standard input".
std::string input_name(const std::string& path);

/// The bytes of a file; of one that gzip packed, what is in it. errors: Failure (kUnreadable): missing, directory, not
/// allowed, read error.
std::string read_input(const std::string& path);

/// "-", or what names standard output otherwise: /dev/stdout, /dev/fd/1, /proc/self/fd/1.
bool is_standard_output(const std::string& path);

/// Writes a file under a temporary name beside it and renames it when it is complete and on the disk: a full disk never
/// leaves half a file and never destroys an old one. A link stays a link. Devices, pipes and open descriptors
/// (/dev/fd/N) are written directly. A reader of standard output that stops reading is no error.
/// errors: Failure (kUsage): the file is one of the inputs that were read; (kDevice): all others, such as a file that
/// may not be written, even where its folder would let it be replaced
void write_output(const std::string& path, std::string_view bytes);

}  // namespace fencepost::host::cli
