// RAII around the GEOS C API with its reentrant handle: the oracle of host/geometry.
#pragma once

#include <geos_c.h>

#include <memory>
#include <string>

#include "host/geometry/polygon.hpp"

namespace fencepost::host {

/// One handle and the conversions to and from our types. Throws std::runtime_error with GEOS's own words when
/// an operation fails; with finite coordinates none does.
class GeosSession {
 public:
  GeosSession();
  ~GeosSession();
  GeosSession(const GeosSession&) = delete;
  GeosSession& operator=(const GeosSession&) = delete;

  struct Destroy {
    GEOSContextHandle_t handle = nullptr;
    void operator()(GEOSGeometry* geometry) const { GEOSGeom_destroy_r(handle, geometry); }
  };
  using Geometry = std::unique_ptr<GEOSGeometry, Destroy>;

  [[nodiscard]] Geometry to_geos(const Polygon& polygon);
  /// Repaired where it is not valid.
  [[nodiscard]] Geometry to_geos(const MultiPolygon& areas);
  /// Polygonal parts only, oriented, rings open.
  [[nodiscard]] MultiPolygon from_geos(const GEOSGeometry* geometry);

  /// Takes ownership; a null result becomes an exception.
  [[nodiscard]] Geometry own(GEOSGeometry* geometry);
  [[nodiscard]] GEOSContextHandle_t handle() const { return handle_; }

  [[nodiscard]] MultiPolygon intersection(const MultiPolygon& a, const MultiPolygon& b);
  [[nodiscard]] double union_area(const MultiPolygon& a, const MultiPolygon& b);
  [[nodiscard]] bool is_valid(const Polygon& polygon);

 private:
  static void remember(const char* message, void* session);
  [[nodiscard]] GEOSGeometry* linear_ring(const LinearRing& ring);
  [[nodiscard]] LinearRing ring_of(const GEOSGeometry* ring);

  GEOSContextHandle_t handle_;
  std::string last_error_;
};

}  // namespace fencepost::host
