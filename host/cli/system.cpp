#include "host/cli/system.hpp"

#include <sys/stat.h>

#include <system_error>

namespace fencepost::host::cli {

namespace fs = std::filesystem;

fs::path installed_share() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  return error ? fs::path() : program.parent_path().parent_path() / "share" / "fencepost";
}

bool names_device(const std::string& path) {
  std::error_code none;
  return path.starts_with("/dev/") || fs::is_character_file(path, none);
}

std::optional<FileId> id_of_file(int descriptor) {
  struct stat about {};
  if (::fstat(descriptor, &about) != 0 || !S_ISREG(about.st_mode)) return std::nullopt;
  return FileId{about.st_dev, about.st_ino};
}

}  // namespace fencepost::host::cli
