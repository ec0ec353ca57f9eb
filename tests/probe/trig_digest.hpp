// One number for the bits of the trigonometry: a change of a single bit anywhere in the sweep changes it.
#pragma once

#include <cstdint>

#include "hal/base/fnv1a.hpp"
#include "hal/base/trig.hpp"

namespace fencepost::probe {

/// Every 1.7 mrad over +-1000 rad, and directions on a grid that reaches from 2^-20 to 2^20.
inline std::uint64_t trig_digest() {
  base::Fnv1a64 digest;
  constexpr std::int64_t kRange = 1'000'000'000;
  constexpr std::int64_t kStep = 1'699;
  for (std::int64_t angle = -kRange; angle <= kRange; angle += kStep) {
    const base::SinCos direction = base::sincos_urad(angle);
    digest.f32(direction.cos);
    digest.f32(direction.sin);
  }
  constexpr int kGrid = 300;
  for (float scale = 1.0F / 1'048'576.0F; scale <= 1'048'576.0F; scale *= 1'024.0F) {
    for (int y = -kGrid; y <= kGrid; ++y) {
      for (int x = -kGrid; x <= kGrid; ++x) {
        digest.f32(base::atan2_rad(static_cast<float>(y) * 0.01F, static_cast<float>(x) * scale));
      }
    }
  }
  return digest.value();
}

}  // namespace fencepost::probe
