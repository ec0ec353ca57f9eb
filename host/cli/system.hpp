// Questions to the system beyond POSIX: system.cpp asks Linux, windows/system.cpp asks Windows.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace fencepost::host::cli {

/// Where an installed program has its recordings and pages; empty: the system does not say where the program is.
std::filesystem::path installed_share();

/// A path of a serial port, even if none is there, rather than of a file: /dev/ttyUSB0, COM3.
bool names_device(const std::string& path);

/// The same for each name of one file.
struct FileId {
  std::uint64_t volume = 0;
  std::uint64_t number = 0;
  bool operator==(const FileId&) const = default;
};
/// Identifies an open file; nothing of a pipe or a device.
std::optional<FileId> id_of_file(int descriptor);

}  // namespace fencepost::host::cli
