#include "host/cli/share.hpp"

#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <vector>

#include "host/cli/exit_code.hpp"

namespace fencepost::host::cli {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> places() {
  if (const char* chosen = std::getenv("FENCEPOST_SHARE")) return {chosen};
  std::vector<fs::path> all;
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (!error) all.push_back(program.parent_path().parent_path() / "share" / "fencepost");
  all.emplace_back(FENCEPOST_SOURCE_SHARE);
  return all;
}

}  // namespace

std::string find_recording(const std::string& file) {
  std::string tried;
  for (const fs::path& place : places()) {
    const fs::path path = place / "recordings" / file;
    std::error_code ignored;
    if (fs::is_regular_file(path, ignored)) return path.string();
    tried += (tried.empty() ? "" : ", ") + path.parent_path().string();
  }
  throw Failure(Exit::kUnreadable, "the bundled recording " + file + " is missing; looked in " + tried +
                                       "; install again, or set FENCEPOST_SHARE to the folder above recordings");
}

}  // namespace fencepost::host::cli
