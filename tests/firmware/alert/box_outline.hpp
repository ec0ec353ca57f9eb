// The outline of a box around its middle, exactly.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "firmware/recon/models/hybrid/hybrid.hpp"
#include "firmware/recon/models/hybrid/node_directions.hpp"

namespace fencepost::test {

class BoxOutline {
 public:
  /// m; `depth` along x, `width` along y, known to `sigma` all around.
  BoxOutline(float depth, float width, float sigma) {
    for (std::size_t k = 0; k < offsets_.size(); ++k) {
      const recon::Vec2 n = recon::node_direction(k, offsets_.size());
      const float reach = 0.5F * (depth * std::fabs(n.x()) + width * std::fabs(n.y()));
      offsets_[k] = static_cast<std::int16_t>(std::lround(reach / recon::kOffsetStep));
    }
    sigmas_.fill(recon::encode_sigma(sigma));
  }
  [[nodiscard]] recon::OutlineView view() const { return {offsets_, sigmas_}; }
  /// As a fit that is known well, around `middle`.
  void put_into(recon::Hybrid<64>& hybrid, recon::MapPoint middle) const {
    hybrid.refusal = recon::HybridRefusal::kNone;
    hybrid.known_well = true;
    hybrid.origin = middle;
    hybrid.offsets = offsets_;
    hybrid.sigmas = sigmas_;
  }

 private:
  std::array<std::int16_t, 64> offsets_{};
  std::array<std::uint8_t, 64> sigmas_{};
};

}  // namespace fencepost::test
