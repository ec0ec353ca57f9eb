#include <CGAL/Boolean_set_operations_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_2.h>
#include <CGAL/Polygon_with_holes_2.h>
#include <CGAL/version.h>

#include <list>
#include <memory>

#include "tests/bench/contender.hpp"

namespace fencepost::bench {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Polygon = CGAL::Polygon_2<Kernel>;

template <std::size_t N>
Polygon polygon_of(const std::array<host::Point, N>& corners) {
  Polygon polygon;
  for (const host::Point& p : corners) polygon.push_back({p.x, p.y});
  return polygon;
}

}  // namespace

// Exact numbers all the way: what that costs.
Contender cgal(const Workload& workload) {
  const auto hulls = std::make_shared<std::vector<Polygon>>(workload.size());
  const auto run = [hulls, &workload] {
    for (std::size_t o = 0; o < workload.size(); ++o) {
      Polygon hull = polygon_of(arena());
      for (const View& view : workload[o].views) {
        std::list<CGAL::Polygon_with_holes_2<Kernel>> result;
        CGAL::intersection(hull, polygon_of(view.triangle), std::back_inserter(result));
        hull = result.empty() ? Polygon{} : result.front().outer_boundary();
      }
      (*hulls)[o] = std::move(hull);
    }
  };
  const auto areas = [hulls] {
    std::vector<double> all;
    for (const Polygon& hull : *hulls) all.push_back(CGAL::to_double(hull.area()));
    return all;
  };
  return {"CGAL " CGAL_VERSION_STR ", exact", Kind::kPolygon, 0, run, areas};
}

}  // namespace fencepost::bench
