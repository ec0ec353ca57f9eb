#include "host/cli/share.hpp"

#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <vector>

#include "host/cli/exit_code.hpp"
#include "host/cli/system.hpp"

namespace fencepost::host::cli {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> places() {
  if (const char* chosen = std::getenv("FENCEPOST_SHARE")) return {chosen};
  std::vector<fs::path> all;
  if (const fs::path installed = installed_share(); !installed.empty()) all.push_back(installed);
  all.emplace_back(FENCEPOST_SOURCE_SHARE);
  return all;
}

// The first that is a file. `what` and `folder` are for the message.
std::string first_of(const std::vector<fs::path>& paths, const std::string& what, const std::string& folder) {
  std::string tried;
  for (const fs::path& path : paths) {
    std::error_code ignored;
    if (fs::is_regular_file(path, ignored)) return path.string();
    tried += (tried.empty() ? "" : ", ") + path.parent_path().string();
  }
  throw Failure(Exit::kUnreadable, what + " is missing; looked in " + tried +
                                       "; install again, or set FENCEPOST_SHARE to the folder above " + folder);
}

}  // namespace

std::string find_recording(const std::string& file) {
  std::vector<fs::path> paths = places();
  for (fs::path& path : paths) path = path / "recordings" / file;
  return first_of(paths, "the bundled recording " + file, "recordings");
}

std::string find_page() {
  constexpr const char* kFile = "fencepost.html";
  std::vector<fs::path> paths = places();
  for (fs::path& path : paths) path = path / "page" / kFile;
  // In the source tree it lies where it is built.
  if (std::getenv("FENCEPOST_SHARE") == nullptr)
    paths.push_back(fs::path(FENCEPOST_SOURCE_SHARE).parent_path() / "web" / "dist" / kFile);
  return first_of(paths, "the page", "page");
}

}  // namespace fencepost::host::cli
