// A solid to render: an outline on the floor, raised to a height band, in one colour.
#pragma once

#include <cstddef>
#include <cstdint>

#include "hal/sensor/blob_frame.hpp"
#include "host/geometry/polygon.hpp"
#include "host/scene/scene.hpp"

namespace fencepost::host {

/// A model or a true object. `owner` is the caller's number for it: solids of one owner are one thing.
struct Solid {
  MultiPolygon footprint;  ///< map frame, m
  double z_min = 0;        ///< m above the floor
  double z_max = 0;
  std::uint8_t signature = 0;
  sensor::Rgb colour;
  std::size_t owner = 0;
};

/// A true object as it is; `owner` is its index.
Solid solid_of(const Scene& scene, std::size_t object);

/// True if a lens at that place would be inside it.
bool encloses(const Solid& solid, double x, double y, double z);

}  // namespace fencepost::host
