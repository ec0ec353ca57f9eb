#include "firmware/recon/models/hybrid/cyclic_band.hpp"

#include "firmware/recon/models/hybrid/tuning.hpp"

namespace fencepost::recon {
namespace {

constexpr std::size_t kA = kRing - 2;  // the two unknowns that close the ring
constexpr std::size_t kB = kRing - 1;

}  // namespace

void CyclicBand::begin_elimination() {
  last_but_one.fill(0);
  last.fill(0);
  last_but_one[0] = second[kA];
  last[0] = first[kB];
  last[1] = second[kB];
  last_but_one[kA - 2] = second[kA - 2];
  last_but_one[kA - 1] = first[kA - 1];
  last[kA - 1] = second[kA - 1];
  second[kA - 2] = 0;
  first[kA - 1] = 0;
  second[kA - 1] = 0;
  original_ = diagonal[0];
  original_next_ = diagonal[1];
  original_last_but_one_ = diagonal[kA];
  original_last_ = diagonal[kB];
}

bool CyclicBand::eliminate(std::size_t k) {
  if (k == kB) return diagonal[kB] > kLeastPivot * original_last_;
  if (k == kA) {
    if (!(diagonal[kA] > kLeastPivot * original_last_but_one_)) return false;
    const float share = first[kA] / diagonal[kA];
    diagonal[kB] -= share * first[kA];
    rhs[kB] -= share * rhs[kA];
    first[kA] = share;
    return true;
  }
  if (!(diagonal[k] > kLeastPivot * original_)) return false;
  original_ = original_next_;
  original_next_ = k + 2 < kRing ? diagonal[k + 2] : 0.0F;
  const float inverse = 1.0F / diagonal[k];
  const float one = first[k] * inverse;
  const float two = second[k] * inverse;
  const float to_a = last_but_one[k] * inverse;
  const float to_b = last[k] * inverse;
  if (k + 1 < kA) {
    diagonal[k + 1] -= one * first[k];
    first[k + 1] -= one * second[k];
    last_but_one[k + 1] -= one * last_but_one[k];
    last[k + 1] -= one * last[k];
    rhs[k + 1] -= one * rhs[k];
  }
  if (k + 2 < kA) {
    diagonal[k + 2] -= two * second[k];
    last_but_one[k + 2] -= two * last_but_one[k];
    last[k + 2] -= two * last[k];
    rhs[k + 2] -= two * rhs[k];
  }
  diagonal[kA] -= to_a * last_but_one[k];
  first[kA] -= to_a * last[k];
  rhs[kA] -= to_a * rhs[k];
  diagonal[kB] -= to_b * last[k];
  rhs[kB] -= to_b * rhs[k];
  first[k] = one;
  second[k] = two;
  last_but_one[k] = to_a;
  last[k] = to_b;
  return true;
}

void CyclicBand::substitute(std::size_t k) {
  rhs[k] /= diagonal[k];
  if (k == kB) return;
  if (k == kA) {
    rhs[kA] -= first[kA] * rhs[kB];
    return;
  }
  if (k + 1 < kA) rhs[k] -= first[k] * rhs[k + 1];
  if (k + 2 < kA) rhs[k] -= second[k] * rhs[k + 2];
  rhs[k] -= last_but_one[k] * rhs[kA] + last[k] * rhs[kB];
}

}  // namespace fencepost::recon
