#include "tests/bench/agreement.hpp"

#include <algorithm>
#include <cmath>

#include "host/geometry/rings.hpp"

namespace fencepost::bench {
namespace {

constexpr double kPolygonShare = 2e-4;  // floats and whole micrometres: 2e-5 is seen
constexpr double kOutlineCells = 1.5;   // a cell's diagonal, and OpenCV's lines

struct Truth {
  double area = 0;
  double outline = 0;  ///< its length
};

Truth truth_of(const Views& object) {
  const auto square = arena();
  host::LinearRing ring(square.begin(), square.end());
  std::vector<host::Wedge> wedges;
  for (const View& view : object.views) wedges.push_back(view.wedge);
  ring = host::intersect_wedges(std::move(ring), wedges);
  Truth truth{host::area({ring, {}}), 0};
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const host::Point& next = ring[i + 1 == ring.size() ? 0 : i + 1];
    truth.outline += std::hypot(next.x - ring[i].x, next.y - ring[i].y);
  }
  return truth;
}

double tolerance(const Contender& contender, const Truth& truth) {
  if (contender.kind == Kind::kPolygon) return kPolygonShare * truth.area;
  const double cell = (arena()[1].x - arena()[0].x) / static_cast<double>(contender.cells);
  return kOutlineCells * truth.outline * cell + 4 * cell * cell;
}

}  // namespace

std::vector<std::string> disagreements(const Workload& workload, std::span<const Contender> contenders) {
  std::vector<Truth> truths;
  std::transform(workload.begin(), workload.end(), std::back_inserter(truths), truth_of);
  std::vector<std::string> faults;
  for (const Contender& contender : contenders) {
    contender.run();
    if (!contender.areas || contender.single_views) continue;
    const std::vector<double> areas = contender.areas();
    for (std::size_t o = 0; o < truths.size(); ++o) {
      const double off = o < areas.size() ? std::fabs(areas[o] - truths[o].area) : truths[o].area;
      if (off <= tolerance(contender, truths[o])) continue;
      faults.push_back(contender.name + ", " + std::to_string(contender.cells) + " cells, object " + std::to_string(o) +
                       ": its area is off by " + std::to_string(off) + " of " + std::to_string(truths[o].area) +
                       " m^2");
    }
  }
  return faults;
}

}  // namespace fencepost::bench
