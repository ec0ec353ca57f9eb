#include "tests/studies/world/car_run.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <stdexcept>

#include "host/geometry/rings.hpp"
#include "host/import/import.hpp"
#include "host/import/table.hpp"
#include "host/replay/replay.hpp"
#include "host/result/lookup.hpp"
#include "host/smooth/par.hpp"
#include "tests/folder.hpp"

namespace fencepost::test {
namespace {

using Settings = std::vector<std::pair<std::string, std::string>>;

host::ResultDocument result_of(const host::ImportResult& imported, const std::string& name, const Settings& settings) {
  if (!imported.ok()) throw std::runtime_error(imported.error().message());
  host::ReplayOptions replay;
  replay.settings = settings;
  const host::ReplayOutcome outcome = host::replay(imported->log, name, replay);
  if (outcome.unreadable) throw std::runtime_error(outcome.unreadable->message);
  return outcome.result;
}

std::vector<host::Point> confirmed(const host::ResultDocument& result) {
  std::vector<host::Point> places;
  for (const host::ObjectResult& object : result.objects) {
    const auto* circle = host::object_circle(object);
    if (circle != nullptr && object.state != record::ObjectState::kTentative) places.push_back(circle->center);
  }
  return places;
}

double distance(host::Point a, host::Point b) { return std::hypot(a.x - b.x, a.y - b.y); }

/// The importer reads the names that the data set gives its files.
class WholeNames {
 public:
  explicit WholeNames(const std::string& from) {
    for (const std::string name : {"measurements.dat", "inputs.dat"}) {
      std::filesystem::create_symlink(std::filesystem::absolute(from) / (name + ".first_half"), folder_.file(name));
    }
  }
  [[nodiscard]] std::string folder() const { return folder_.path().string(); }

 private:
  test::Folder folder_;
};

std::optional<host::Point> at(const std::vector<host::PoseResult>& path, double t) {
  const auto next = std::ranges::lower_bound(path, t, {}, &host::PoseResult::t);
  if (next == path.end()) return std::nullopt;
  return host::Point{next->x, next->y};
}

}  // namespace

CycloidScore run_cycloid(const std::string& folder, const Settings& settings) {
  constexpr double kFound = 0.5;  // m, of a cone's place
  // m, of the last pose, by a filter of 20,000 particles that knows the cones. 300 lose the car after a minute.
  constexpr host::Point kEnd = {-0.07, -0.12};
  const host::ImportResult imported = host::import_cycloid(folder + "/194625.txt", folder + "/lm.txt");
  const host::ResultDocument result = result_of(imported, folder, settings);
  std::vector<host::Point> free = confirmed(result);
  CycloidScore score;
  score.objects = free.size();
  double squares = 0;
  for (const host::SceneObject& cone : imported->truth->objects) {
    host::Point place;
    double radius = 0;
    if (!host::is_circle_ring(cone.footprint.outer, place, radius)) throw std::runtime_error("a cone is round");
    const auto near = std::ranges::min_element(free, {}, [&](host::Point p) { return distance(p, place); });
    if (near == free.end() || distance(*near, place) > kFound) continue;
    squares += distance(*near, place) * distance(*near, place);
    ++score.cones;
    free.erase(near);
  }
  score.rms = score.cones > 0 ? std::sqrt(squares / static_cast<double>(score.cones)) : 0;
  score.end_error = distance({result.pose.value().x, result.pose.value().y}, kEnd);
  return score;
}

VictoriaScore run_victoria(const std::string& folder, bool rows, const Settings& settings) {
  const WholeNames names(folder);
  host::VictoriaOptions options;
  options.rows = rows;
  const host::ResultDocument result = result_of(host::import_victoria(names.folder(), options), folder, settings);
  const double start = host::read_space_table(names.folder() + "/measurements.dat", 4, "").rows.front().values[0];
  const double zero = std::min(start, host::read_space_table(names.folder() + "/inputs.dat", 3, "").rows[0].values[0]);
  std::vector<host::PointPair> pairs;
  for (const host::TableRow& row : host::read_space_table(folder + "/gps.dat.first_half", 3, "time x y").rows) {
    const auto pose = at(result.path, row.values[0] - zero);
    if (pose && row.values[0] >= zero)
      pairs.push_back({{pose->x / options.scale, pose->y / options.scale}, {row.values[1], row.values[2]}});
  }
  const std::vector<double> off = host::distances_after(host::aligned(pairs), pairs);
  return {host::rms_of(off), std::ranges::max(off), confirmed(result).size()};
}

}  // namespace fencepost::test
