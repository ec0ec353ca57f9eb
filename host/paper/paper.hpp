// The paper's evaluation as a folder: one page, its drawings and their numbers.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/paper/figure.hpp"

namespace fencepost::host {

/// A recorded run, to be evaluated instead of simulated scenes.
struct PaperRun {
  std::string name;
  Tour tour;
};

struct PaperOptions {
  std::uint64_t seed = 1;
  std::size_t scenes = 60;         ///< of Figure 10
  std::size_t mean_scenes = 20;    ///< of the curves
  std::size_t single_scenes = 20;  ///< in each of which, alone, every claim is looked at again
  std::optional<PaperRun> run;     ///< then the seed and the numbers of scenes play no part
  std::string generator = "fencepost";
  /// Gets the finished step, and the work done of all work; from several threads, one after the other.
  std::function<void(std::string_view what, double done, double all)> progress;
};

/// index.html first. The same options give the same bytes. Drawings and CSV files lie beside the page. errors:
/// std::runtime_error: a run with too few frames or objects.
std::vector<PaperFile> write_paper(const PaperOptions& options);

}  // namespace fencepost::host
