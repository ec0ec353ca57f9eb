#include <geos_c.h>

#include <memory>
#include <stdexcept>

#include "tests/bench/contender.hpp"

namespace fencepost::bench {
namespace {

class Geos {
 public:
  Geos() : handle_(GEOS_init_r()) {}
  Geos(const Geos&) = delete;
  Geos& operator=(const Geos&) = delete;
  ~Geos() { GEOS_finish_r(handle_); }

  using Geometry = std::unique_ptr<GEOSGeometry, std::function<void(GEOSGeometry*)>>;

  template <std::size_t N>
  [[nodiscard]] Geometry polygon(const std::array<host::Point, N>& corners) const {
    GEOSCoordSequence* ring = GEOSCoordSeq_create_r(handle_, N + 1, 2);
    for (unsigned i = 0; i <= N; ++i) GEOSCoordSeq_setXY_r(handle_, ring, i, corners[i % N].x, corners[i % N].y);
    return own(GEOSGeom_createPolygon_r(handle_, GEOSGeom_createLinearRing_r(handle_, ring), nullptr, 0));
  }
  [[nodiscard]] Geometry both(const Geometry& a, const Geometry& b) const {
    return own(GEOSIntersection_r(handle_, a.get(), b.get()));
  }
  [[nodiscard]] double area(const Geometry& geometry) const {
    double area = 0;
    GEOSArea_r(handle_, geometry.get(), &area);
    return area;
  }

 private:
  [[nodiscard]] Geometry own(GEOSGeometry* geometry) const {
    if (geometry == nullptr) throw std::runtime_error("GEOS gave no geometry");
    return {geometry, [handle = handle_](GEOSGeometry* g) { GEOSGeom_destroy_r(handle, g); }};
  }

  GEOSContextHandle_t handle_;
};

}  // namespace

Contender geos(const Workload& workload) {
  struct State {
    Geos geos;
    std::vector<Geos::Geometry> hulls;
  };
  const auto state = std::make_shared<State>();
  const auto run = [state, &workload] {
    state->hulls.clear();
    for (const Views& object : workload) {
      Geos::Geometry hull = state->geos.polygon(arena());
      for (const View& view : object.views) hull = state->geos.both(hull, state->geos.polygon(view.triangle));
      state->hulls.push_back(std::move(hull));
    }
  };
  const auto areas = [state] {
    std::vector<double> all;
    for (const Geos::Geometry& hull : state->hulls) all.push_back(state->geos.area(hull));
    return all;
  };
  return {"GEOS " + std::string(GEOSversion()).substr(0, 6), Kind::kPolygon, 0, run, areas};
}

}  // namespace fencepost::bench
