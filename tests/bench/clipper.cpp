#include <cmath>
#include <memory>
#include <polyclipping/clipper.hpp>

#include "tests/bench/contender.hpp"

namespace fencepost::bench {
namespace {

constexpr double kPerMetre = 1e6;

template <std::size_t N>
ClipperLib::Path path_of(const std::array<host::Point, N>& corners) {
  ClipperLib::Path path;
  for (const host::Point& p : corners) path.emplace_back(std::llround(p.x * kPerMetre), std::llround(p.y * kPerMetre));
  return path;
}

}  // namespace

Contender clipper(const Workload& workload) {
  const auto hulls = std::make_shared<std::vector<ClipperLib::Paths>>(workload.size());
  const auto run = [hulls, &workload] {
    ClipperLib::Clipper clipper;
    for (std::size_t o = 0; o < workload.size(); ++o) {
      ClipperLib::Paths hull{path_of(arena())};
      for (const View& view : workload[o].views) {
        ClipperLib::Paths result;
        clipper.Clear();
        clipper.AddPaths(hull, ClipperLib::ptSubject, true);
        clipper.AddPath(path_of(view.triangle), ClipperLib::ptClip, true);
        clipper.Execute(ClipperLib::ctIntersection, result, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
        hull.swap(result);
      }
      (*hulls)[o] = std::move(hull);
    }
  };
  const auto areas = [hulls] {
    std::vector<double> all;
    for (const ClipperLib::Paths& hull : *hulls) {
      all.push_back(hull.empty() ? 0 : ClipperLib::Area(hull[0]) / (kPerMetre * kPerMetre));
    }
    return all;
  };
  return {"Clipper " CLIPPER_VERSION, Kind::kPolygon, 0, run, areas};
}

}  // namespace fencepost::bench
