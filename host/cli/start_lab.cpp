#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>
#include <vector>

#include "host/cli/lab.hpp"
#include "host/doctor/finding.hpp"
#include "host/smooth/smooth_evaluation.hpp"

namespace fencepost::host::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kName = "fencepost-lab";

/// Beside this program, and where an installation has it.
std::array<fs::path, 2> lab_places() {
  std::error_code error;
  const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  return {folder / kName, folder.parent_path() / "libexec" / "fencepost" / kName};
}

/// As this program was called, to the byte.
std::vector<std::string> command_line() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  const std::string all{std::istreambuf_iterator<char>(file), {}};
  std::vector<std::string> words;
  for (std::size_t at = 0; at < all.size(); at += words.back().size() + 1) words.emplace_back(all.c_str() + at);
  return words;
}

/// Returns only where it is not there. errors: Failure (kUnreadable): it cannot be started
void try_lab() {
  std::vector<std::string> words = command_line();
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  for (const fs::path& path : lab_places()) {
    ::execv(path.c_str(), arguments.data());
    if (errno != ENOENT && errno != ENOTDIR) {
      throw Failure(Exit::kUnreadable, fmt::format("cannot start {}: {}; install again", path.string(),
                                                   std::generic_category().message(errno)));
    }
  }
}

/// `what`: the command that needs it. errors: Failure (kUnreadable): not there
[[noreturn]] void start_lab(const char* what) {
  try_lab();
  const std::array<fs::path, 2> places = lab_places();
  const fs::path folder = places[0].parent_path();
  // An installed program looks only where it was installed.
  const std::string install = folder.filename() == "bin" ? fmt::format(" && cmake --install build/demo --prefix '{}'",
                                                                       folder.parent_path().string())
                                                         : std::string();
  throw Failure(Exit::kUnreadable,
                fmt::format("{} needs {}, which is neither in {} nor in {}; install Debian's package, or build it: "
                            "toolchain/setup host lab && cmake --preset demo -DFENCEPOST_LAB=ON && "
                            "cmake --build --preset demo{}",
                            what, kName, folder.string(), places[1].parent_path().string(), install));
}

}  // namespace

Exit run_calibrate(const CalibrateRequest&) { start_lab("calibrate"); }
Exit run_import_cycloid(const SetRequest&, const std::string&) { start_lab("import cycloid"); }
Exit run_import_victoria(const SetRequest&, const VictoriaOptions&) { start_lab("import victoria"); }
Exit run_import_dlr(const SetRequest&, const DlrOptions&) { start_lab("import dlr"); }
Exit run_import_kitti(const SetRequest&, const KittiOptions&) { start_lab("import kitti"); }
Exit run_import_mrclam(const SetRequest&) { start_lab("import mrclam"); }
Exit run_import_rings(const SetRequest&) { start_lab("import rings"); }
Exit run_merge(const MergeRequest&) { start_lab("merge"); }
Exit run_paper(const PaperRequest&) { start_lab("paper"); }
Exit run_segment(const SegmentRequest&) { start_lab("segment"); }
Exit run_smooth(const SmoothRequest&) { start_lab("smooth"); }
void need_lab(const char* what) { start_lab(what); }
bool has_lab() {
  try_lab();
  return false;
}
std::vector<doctor::Finding> distance_findings(std::string_view, const std::string&) { return {}; }

// Nobody comes here after need_lab().
SmoothEvaluation smooth_log(const std::string&, const Scene&, const EvaluateOptions&) { std::abort(); }
std::string with_smoothed(const std::string&, bool, const std::vector<SmoothEvaluation>&) { std::abort(); }
std::string png_file(const exports::Drawing&, double) { std::abort(); }

}  // namespace fencepost::host::cli
