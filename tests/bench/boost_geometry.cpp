#include <boost/geometry.hpp>
#include <boost/geometry/geometries/multi_polygon.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <boost/version.hpp>
#include <memory>

#include "tests/bench/contender.hpp"

namespace fencepost::bench {
namespace {

namespace bg = boost::geometry;
using Corner = bg::model::d2::point_xy<double>;
using Polygon = bg::model::polygon<Corner, false>;  // counter-clockwise

template <std::size_t N>
Polygon polygon_of(const std::array<host::Point, N>& corners) {
  Polygon polygon;
  for (std::size_t i = 0; i <= N; ++i) bg::append(polygon.outer(), Corner(corners[i % N].x, corners[i % N].y));
  return polygon;
}

}  // namespace

Contender boost_geometry(const Workload& workload) {
  const auto hulls = std::make_shared<std::vector<Polygon>>(workload.size());
  const auto run = [hulls, &workload] {
    for (std::size_t o = 0; o < workload.size(); ++o) {
      Polygon hull = polygon_of(arena());
      for (const View& view : workload[o].views) {
        bg::model::multi_polygon<Polygon> result;
        bg::intersection(hull, polygon_of(view.triangle), result);
        hull = result.empty() ? Polygon{} : std::move(result[0]);
      }
      (*hulls)[o] = std::move(hull);
    }
  };
  const auto areas = [hulls] {
    std::vector<double> all;
    for (const Polygon& hull : *hulls) all.push_back(bg::area(hull));
    return all;
  };
  constexpr int kMajor = BOOST_VERSION / 100000;
  constexpr int kMinor = BOOST_VERSION / 100 % 1000;
  return {"Boost.Geometry " + std::to_string(kMajor) + "." + std::to_string(kMinor), Kind::kPolygon, 0, run, areas};
}

}  // namespace fencepost::bench
