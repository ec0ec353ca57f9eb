#include "firmware/recon/models/hybrid/cyclic_band.hpp"

#include "firmware/recon/models/hybrid/tuning.hpp"

namespace fencepost::recon {

void CyclicBand::begin_elimination() {
  last_but_one.fill(0);
  last.fill(0);
  last_but_one[0] = second[kLastButOne];
  last[0] = first[kLast];
  last[1] = second[kLast];
  last_but_one[kLastButOne - 2] = second[kLastButOne - 2];
  last_but_one[kLastButOne - 1] = first[kLastButOne - 1];
  last[kLastButOne - 1] = second[kLastButOne - 1];
  second[kLastButOne - 2] = 0;
  first[kLastButOne - 1] = 0;
  second[kLastButOne - 1] = 0;
  original_ = diagonal[0];
  original_next_ = diagonal[1];
  original_last_but_one_ = diagonal[kLastButOne];
  original_last_ = diagonal[kLast];
}

bool CyclicBand::eliminate(std::size_t k) {
  if (k == kLast) return diagonal[kLast] > kMinPivot * original_last_;
  if (k == kLastButOne) {
    if (!(diagonal[kLastButOne] > kMinPivot * original_last_but_one_)) return false;
    const float share = first[kLastButOne] / diagonal[kLastButOne];
    diagonal[kLast] -= share * first[kLastButOne];
    rhs[kLast] -= share * rhs[kLastButOne];
    first[kLastButOne] = share;
    return true;
  }
  if (!(diagonal[k] > kMinPivot * original_)) return false;
  original_ = original_next_;
  original_next_ = k + 2 < kRing ? diagonal[k + 2] : 0;
  const float inverse = 1.0F / diagonal[k];
  const float one = first[k] * inverse;
  const float two = second[k] * inverse;
  const float to_a = last_but_one[k] * inverse;
  const float to_b = last[k] * inverse;
  if (k + 1 < kLastButOne) {
    diagonal[k + 1] -= one * first[k];
    first[k + 1] -= one * second[k];
    last_but_one[k + 1] -= one * last_but_one[k];
    last[k + 1] -= one * last[k];
    rhs[k + 1] -= one * rhs[k];
  }
  if (k + 2 < kLastButOne) {
    diagonal[k + 2] -= two * second[k];
    last_but_one[k + 2] -= two * last_but_one[k];
    last[k + 2] -= two * last[k];
    rhs[k + 2] -= two * rhs[k];
  }
  diagonal[kLastButOne] -= to_a * last_but_one[k];
  first[kLastButOne] -= to_a * last[k];
  rhs[kLastButOne] -= to_a * rhs[k];
  diagonal[kLast] -= to_b * last[k];
  rhs[kLast] -= to_b * rhs[k];
  first[k] = one;
  second[k] = two;
  last_but_one[k] = to_a;
  last[k] = to_b;
  return true;
}

void CyclicBand::substitute(std::size_t k) {
  rhs[k] /= diagonal[k];
  if (k == kLast) return;
  if (k == kLastButOne) {
    rhs[kLastButOne] -= first[kLastButOne] * rhs[kLast];
    return;
  }
  if (k + 1 < kLastButOne) rhs[k] -= first[k] * rhs[k + 1];
  if (k + 2 < kLastButOne) rhs[k] -= second[k] * rhs[k + 2];
  rhs[k] -= last_but_one[k] * rhs[kLastButOne] + last[k] * rhs[kLast];
}

}  // namespace fencepost::recon
