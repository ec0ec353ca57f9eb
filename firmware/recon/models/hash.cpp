#include "firmware/recon/models/hash.hpp"

namespace fencepost::recon {

void hash_vec(base::Fnv1a64& hash, const Vec2& v) {
  hash.f32(v.x());
  hash.f32(v.y());
}

}  // namespace fencepost::recon
