#include "tests/studies/alerts/ground_truth.hpp"

#include <algorithm>
#include <cmath>

namespace fencepost::test {
namespace {

constexpr double kStep = 0.01;   // s
constexpr double kBeyond = 1.0;  // m: a thing that the robot would touch if the run went on is in its path, too
constexpr double kNearly = 1.5;  // a stop this many times too early is still right

}  // namespace

GroundTruth::GroundTruth(const Approach& approach, const AlertLimits& limits) : approach_(approach), limits_(limits) {
  const double last = approach.end + kBeyond / approach.drive.speed;
  for (const host::SceneObject& object : approach.scene.objects) {
    std::vector<double>& distances = samples_.emplace_back();
    for (int i = 0; i * kStep <= last; ++i) {
      const host::TimedPose pose = approach.drive.at(i * kStep);
      distances.push_back(distance_to(object.footprint, {pose.x, pose.y}));
    }
    std::vector<double>& nearest = nearest_.emplace_back(distances);
    for (std::size_t i = nearest.size() - 1; i-- > 0;) nearest[i] = std::min(nearest[i], nearest[i + 1]);
  }
}

std::size_t GroundTruth::index(double t) const {
  const auto nearest = static_cast<std::size_t>(std::lround(std::max(0.0, t) / kStep));
  return std::min(nearest, samples_.front().size() - 1);
}

bool GroundTruth::swept(std::size_t object, double t, double half_width) const {
  return nearest_[object][index(t)] <= half_width;
}

std::optional<double> GroundTruth::stop_time(std::size_t object) const {
  if (!in_path(object, 0) || distance(object, 0) <= limits_.stop) return std::nullopt;
  const std::vector<double>& distances = samples_[object];
  const auto near = std::find_if(distances.begin(), distances.end(), [&](double d) { return d <= limits_.stop; });
  const double t = kStep * static_cast<double>(near - distances.begin());
  if (t > approach_.end) return std::nullopt;
  return t;
}

bool GroundTruth::stop_is_right(double t, double grace) const {
  const bool drives = t > approach_.drive.standing;
  const double soon = drives ? limits_.half_width + limits_.ttc_stop * kNearly * approach_.drive.speed : 0;
  const double limit = std::max(kNearly * limits_.stop, soon);
  for (std::size_t object = 0; object < samples_.size(); ++object) {
    const bool meets = swept(object, t, limits_.half_width + limits_.margin + grace);
    if (meets && distance(object, t) <= limit) return true;
  }
  return false;
}

}  // namespace fencepost::test
