// One run as one HTML file that needs nothing else, no network and no script: for paper, mail and old browsers.
#pragma once

#include <optional>
#include <string>

#include "host/result/result.hpp"
#include "host/scene/scene.hpp"

namespace fencepost::host {

struct ReportOptions {
  std::string title = "Fencepost report";  ///< usually the log's name; escaped
  std::string generator = "fencepost";     ///< program and version, in the footer
  std::string note{};                      ///< under the title; escaped
};

/// Where `truth` is given, the map shows its footprints and a table says how far off each model is. The same input
/// gives the same bytes: no date, no path of this machine.
std::string write_report(const ResultDocument& document, const std::optional<Scene>& truth,
                         const ReportOptions& options);

}  // namespace fencepost::host
