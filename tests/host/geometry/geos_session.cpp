#include "tests/host/geometry/geos_session.hpp"

#include <stdexcept>
#include <utility>
#include <vector>

#include "host/geometry/rings.hpp"

namespace fencepost::host {

GeosSession::GeosSession() : handle_(GEOS_init_r()) {
  GEOSContext_setErrorMessageHandler_r(handle_, &GeosSession::remember, this);
}

GeosSession::~GeosSession() { GEOS_finish_r(handle_); }

void GeosSession::remember(const char* message, void* session) {
  static_cast<GeosSession*>(session)->last_error_ = message;
}

GeosSession::Geometry GeosSession::own(GEOSGeometry* geometry) {
  if (geometry == nullptr) throw std::runtime_error("GEOS: " + last_error_);
  return Geometry(geometry, Destroy{handle_});
}

GEOSGeometry* GeosSession::linear_ring(const LinearRing& ring) {
  const LinearRing points = closed(ring);
  GEOSCoordSequence* sequence = GEOSCoordSeq_create_r(handle_, static_cast<unsigned>(points.size()), 2);
  for (unsigned i = 0; i < points.size(); ++i) {
    GEOSCoordSeq_setXY_r(handle_, sequence, i, points[i].x, points[i].y);
  }
  return own(GEOSGeom_createLinearRing_r(handle_, sequence)).release();
}

GeosSession::Geometry GeosSession::to_geos(const Polygon& polygon) {
  if (polygon.outer.size() < 3) return own(GEOSGeom_createEmptyPolygon_r(handle_));
  std::vector<GEOSGeometry*> holes;
  for (const LinearRing& hole : polygon.holes) {
    if (hole.size() >= 3) holes.push_back(linear_ring(hole));
  }
  return own(
      GEOSGeom_createPolygon_r(handle_, linear_ring(polygon.outer), holes.data(), static_cast<unsigned>(holes.size())));
}

GeosSession::Geometry GeosSession::to_geos(const MultiPolygon& areas) {
  std::vector<GEOSGeometry*> parts;
  for (const Polygon& polygon : areas) {
    Geometry part = to_geos(polygon);
    if (GEOSisValid_r(handle_, part.get()) != 1) part = own(GEOSMakeValid_r(handle_, part.get()));
    parts.push_back(part.release());
  }
  const Geometry collection = own(
      GEOSGeom_createCollection_r(handle_, GEOS_GEOMETRYCOLLECTION, parts.data(), static_cast<unsigned>(parts.size())));
  return own(GEOSUnaryUnion_r(handle_, collection.get()));
}

LinearRing GeosSession::ring_of(const GEOSGeometry* ring) {
  const GEOSCoordSequence* sequence = GEOSGeom_getCoordSeq_r(handle_, ring);
  unsigned size = 0;
  GEOSCoordSeq_getSize_r(handle_, sequence, &size);
  LinearRing points(size);
  for (unsigned i = 0; i < size; ++i) GEOSCoordSeq_getXY_r(handle_, sequence, i, &points[i].x, &points[i].y);
  return opened(std::move(points));
}

MultiPolygon GeosSession::from_geos(const GEOSGeometry* geometry) {
  MultiPolygon result;
  const int type = GEOSGeomTypeId_r(handle_, geometry);
  if (type == GEOS_POLYGON) {
    if (GEOSisEmpty_r(handle_, geometry) == 1) return result;
    Polygon polygon;
    polygon.outer = ring_of(GEOSGetExteriorRing_r(handle_, geometry));
    const int holes = GEOSGetNumInteriorRings_r(handle_, geometry);
    for (int i = 0; i < holes; ++i) polygon.holes.push_back(ring_of(GEOSGetInteriorRingN_r(handle_, geometry, i)));
    result.push_back(oriented(std::move(polygon)));
  } else if (type == GEOS_MULTIPOLYGON || type == GEOS_GEOMETRYCOLLECTION) {
    const int parts = GEOSGetNumGeometries_r(handle_, geometry);
    for (int i = 0; i < parts; ++i) {
      // Depth one: GEOS's overlay results do not nest.
      for (Polygon& polygon : from_geos(GEOSGetGeometryN_r(handle_, geometry, i))) result.push_back(std::move(polygon));
    }
  }
  return result;
}

MultiPolygon GeosSession::intersection(const MultiPolygon& a, const MultiPolygon& b) {
  return from_geos(own(GEOSIntersection_r(handle_, to_geos(a).get(), to_geos(b).get())).get());
}

double GeosSession::union_area(const MultiPolygon& a, const MultiPolygon& b) {
  return area(from_geos(own(GEOSUnion_r(handle_, to_geos(a).get(), to_geos(b).get())).get()));
}

bool GeosSession::is_valid(const Polygon& polygon) { return GEOSisValid_r(handle_, to_geos(polygon).get()) == 1; }

}  // namespace fencepost::host
