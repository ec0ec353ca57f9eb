#include "tests/studies/world/dlr_run.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "host/import/dlr/dlr_files.hpp"
#include "host/import/import.hpp"
#include "host/replay/replay.hpp"
#include "tests/firmware/record/lines.hpp"
#include "tests/studies/common/median.hpp"
#include "tests/studies/drift/textbook_filter.hpp"

namespace fencepost::test {
namespace {

constexpr std::size_t kMinSightings = 3;  // of a disc that counts

double scatter(const std::vector<host::Point>& places) {
  std::vector<double> x;
  std::vector<double> y;
  for (const host::Point& place : places) x.push_back(place.x), y.push_back(place.y);
  const double at_x = median_of(x);
  const double at_y = median_of(y);
  double sum = 0;
  for (const host::Point& place : places) sum += std::hypot(place.x - at_x, place.y - at_y);
  return sum / static_cast<double>(places.size());
}

template <class Path>
double scatter_of(const std::vector<host::DlrStep>& steps, std::size_t from, const Path& path) {
  std::map<int, std::vector<host::Point>> places;
  for (const auto& pose : path) {
    const auto step = from + static_cast<std::size_t>(std::lround(pose.t / host::kDlrPeriod));
    for (const host::DlrDisc& disc : steps.at(step).discs) {
      if (disc.id < 0) continue;
      const double c = std::cos(pose.heading), s = std::sin(pose.heading);
      places[disc.id].push_back({pose.x + c * disc.x - s * disc.y, pose.y + s * disc.x + c * disc.y});
    }
  }
  double sum = 0;
  std::size_t discs = 0;
  for (const auto& [id, sightings] : places) {
    if (sightings.size() < kMinSightings) continue;
    sum += scatter(sightings);
    ++discs;
  }
  if (discs == 0) throw std::runtime_error("a window of DLR has no disc that was seen three times");
  return sum / static_cast<double>(discs);
}

// `path_of(log)` of each window's log.
template <class PathOf>
std::vector<double> scatters(const std::string& file, std::size_t steps, bool identity, const PathOf& path_of) {
  const std::vector<host::DlrStep> all = host::read_dlr(file);
  std::vector<double> windows;
  for (std::size_t from = 0; from + steps < all.size(); from += steps) {
    host::DlrOptions options;
    options.identity = identity;
    options.from = from;
    options.to = from + steps;
    const host::ImportResult imported = host::import_dlr(file, options);
    if (!imported.ok()) throw std::runtime_error(imported.error().message());
    windows.push_back(scatter_of(all, from, path_of(imported->log)));
  }
  return windows;
}

}  // namespace

std::vector<double> run_dlr(const std::string& file, std::size_t steps, bool identity,
                            const std::vector<std::pair<std::string, std::string>>& settings) {
  return scatters(file, steps, identity, [&](const std::string& log) {
    host::ReplayOptions replay;
    replay.settings = settings;
    host::ReplayOutcome outcome = host::replay(log, file, replay);
    if (outcome.unreadable) throw std::runtime_error(outcome.unreadable->message);
    return std::move(outcome.result.path);
  });
}

std::vector<double> run_dlr_by_textbook(const std::string& file, std::size_t steps) {
  return scatters(file, steps, true, [](const std::string& log) {
    return run_textbook(log, host::kDlrDiscRadius, host::kDlrUnknownDisc).path;
  });
}

}  // namespace fencepost::test
