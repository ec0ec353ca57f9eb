#include "host/simulate/simulate.hpp"

#include "host/simulate/simulation.hpp"

namespace fencepost::host {

namespace {

/// Maximum pixels of an image, since each costs memory and time; photographs have the same limit.
constexpr std::uint64_t kMaxPixels = 64U << 20U;

std::string too_large(const sensor::CameraIntrinsics& camera) {
  return "an image of " + std::to_string(camera.width) + " x " + std::to_string(camera.height) +
         " pixels is too large to be rendered, more than 64 megapixels; give the camera's own \"width\" and \"height\"";
}

bool can_be_rendered(const sensor::CameraIntrinsics& camera) {
  return std::uint64_t{camera.width} * camera.height <= kMaxPixels;
}

std::string out_of_range() {
  return "a value is outside the range of its record (positions +-1000 m, headings +-1000 rad, t up to 999999 s); "
         "shorten the path or move it nearer to the origin";
}

}  // namespace

base::Result<SimulationSummary, std::string> simulate(const Scene& scene, const LineSink& sink) {
  return simulate_with_truth(scene, sink, {});
}

base::Result<SimulationSummary, std::string> simulate_with_truth(const Scene& scene, const LineSink& sink,
                                                                 const TruthSink& truth) {
  if (std::holds_alternative<std::monostate>(scene.path)) {
    return std::string("the scene has no path to drive; add \"path\" (arc, waypoints or poses)");
  }
  if (!can_be_rendered(scene.camera)) return too_large(scene.camera);
  Simulation simulation(scene, Trajectory(scene), sink, truth);
  if (!simulation.run()) return out_of_range();
  return simulation.summary();
}

base::Result<SimulationSummary, std::string> simulate_driven(const Scene& scene, const Driven& driven,
                                                             const LineSink& sink, const TruthSink& truth) {
  if (!can_be_rendered(scene.camera)) return too_large(scene.camera);
  Simulation simulation(scene, Trajectory(scene, driven.pose, driven.duration), sink, truth);
  if (!simulation.run(driven.ended)) return out_of_range();
  return simulation.summary();
}

}  // namespace fencepost::host
