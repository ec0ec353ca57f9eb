// Geometry in the state digest (firmware/recon/DIGEST.md): field by field, floats by their bits.
#pragma once

#include "firmware/recon/geometry.hpp"
#include "hal/base/fnv1a.hpp"

namespace fencepost::recon {

void hash_vec(base::Fnv1a64& hash, const Vec2& v);

}  // namespace fencepost::recon
