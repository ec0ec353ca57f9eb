// A cyclic band solved in one go, to the same bits as CyclicBandOf, which does it row by row. The two rows that each
// row changes stay in registers. Work that no other row waits for is done beside it.
#pragma once

#include <array>
#include <cstddef>

#include "firmware/recon/models/hybrid/cyclic_band.hpp"
#include "firmware/recon/models/hybrid/triangle.hpp"
#include "firmware/recon/models/hybrid/tuning.hpp"

namespace fencepost::recon {

/// The parts of each row that elimination leaves, for the way back.
template <class Number>
struct BandFactors {
  std::array<Number, kRing> first;
  std::array<Number, kRing> second;
  std::array<Number, kRing> last_but_one;
  std::array<Number, kRing> last;
};

/// A row during elimination.
template <class Number>
struct BandRow {
  Number diagonal;
  Number first;
  Number second;
  Number rhs;
  Number last_but_one;
  Number last;
};

inline constexpr std::size_t kTail = kLastButOne - 2;  ///< from here on neighbours are among the last two

/// All before the last two, whose solutions `rhs` has already. `one`: the share of row kTail in the one after it.
template <class Number, class Column>
[[gnu::always_inline]] inline void substitute_back(const BandFactors<Number>& factors, const Number& one, Column& rhs) {
  const Number at_last = rhs[kLast];
  const Number at_last_but_one = rhs[kLastButOne];
  const auto by_the_ends = [&](std::size_t k) {
    return factors.last_but_one[k] * at_last_but_one + factors.last[k] * at_last;
  };
  Number second_next = rhs[kTail + 1] - by_the_ends(kTail + 1);
  rhs[kTail + 1] = second_next;
  Number last_next = rhs[kTail] - one * second_next - by_the_ends(kTail);
  rhs[kTail] = last_next;
  for (std::size_t k = kTail; k-- > 0;) {
    const Number value = rhs[k] - factors.first[k] * last_next - factors.second[k] * second_next - by_the_ends(k);
    rhs[k] = value;
    second_next = last_next;
    last_next = value;
  }
}

template <class Number>
[[gnu::always_inline]] inline void take_from_next(const BandRow<Number>& row, const Number& share,
                                                  BandRow<Number>& next) {
  next.diagonal -= share * row.first;
  next.first -= share * row.second;
  next.last_but_one -= share * row.last_but_one;
  next.last -= share * row.last;
  next.rhs -= share * row.rhs;
}

/// `Equations`: columns diagonal, first, second and rhs, as CyclicBandOf has them; rhs becomes the solution, the others
/// stay. False, for lanes 0: a pivot is lost to rounding, and the solution has no meaning.
template <class Number, class Equations>
[[gnu::always_inline]] inline Kept<Number> solve_band(Equations& equations, BandFactors<Number>& factors) {
  const auto& diagonal = equations.diagonal;
  const auto& first = equations.first;
  const auto& second = equations.second;
  auto& rhs = equations.rhs;
  const Number nothing{};
  const auto row_at = [&](std::size_t k) {
    return BandRow<Number>{diagonal[k], first[k], second[k], rhs[k], nothing, nothing};
  };
  Kept<Number> kept = diagonal[0] > kMinPivot * diagonal[0];
  // The block that closes the ring.
  Number corner = diagonal[kLastButOne];
  Number side = first[kLastButOne];
  Number corner_rhs = rhs[kLastButOne];
  Number end = diagonal[kLast];
  Number end_rhs = rhs[kLast];
  const auto close = [&](std::size_t k, const BandRow<Number>& row, const Number& inverse) {
    const Number to_last_but_one = row.last_but_one * inverse;
    const Number to_last = row.last * inverse;
    corner -= to_last_but_one * row.last_but_one;
    side -= to_last_but_one * row.last;
    corner_rhs -= to_last_but_one * row.rhs;
    end -= to_last * row.last;
    end_rhs -= to_last * row.rhs;
    factors.last_but_one[k] = to_last_but_one;
    factors.last[k] = to_last;
    rhs[k] = row.rhs / row.diagonal;
    kept &= row.diagonal > kMinPivot * diagonal[k];
  };

  BandRow<Number> row = row_at(0);
  BandRow<Number> next = row_at(1);
  row.last_but_one = second[kLastButOne];
  row.last = first[kLast];
  next.last = second[kLast];
  const auto eliminate = [&](std::size_t k, BandRow<Number> after) {
    const Number inverse = 1.0F / row.diagonal;
    const Number one = row.first * inverse;
    const Number two = row.second * inverse;
    take_from_next(row, one, next);
    after.diagonal -= two * row.second;
    after.last_but_one -= two * row.last_but_one;
    after.last -= two * row.last;
    after.rhs -= two * row.rhs;
    factors.first[k] = one;
    factors.second[k] = two;
    close(k, row, inverse);
    row = next;
    next = after;
  };
  for (std::size_t k = 0; k + 2 < kTail; ++k) eliminate(k, row_at(k + 2));
  BandRow<Number> after = row_at(kTail);
  after.last_but_one = second[kTail];
  after.second = nothing;
  eliminate(kTail - 2, after);
  after = row_at(kTail + 1);
  after.last_but_one = first[kTail + 1];
  after.last = second[kTail + 1];
  after.first = after.second = nothing;
  eliminate(kTail - 1, after);
  const Number inverse = 1.0F / row.diagonal;
  const Number one = row.first * inverse;
  take_from_next(row, one, next);
  close(kTail, row, inverse);
  close(kTail + 1, next, 1.0F / next.diagonal);
  kept &= corner > kMinPivot * diagonal[kLastButOne];
  const Number share = side / corner;
  end -= share * side;
  end_rhs -= share * corner_rhs;
  kept &= end > kMinPivot * diagonal[kLast];

  const Number at_last = end_rhs / end;
  const Number at_last_but_one = corner_rhs / corner - share * at_last;
  rhs[kLast] = at_last;
  rhs[kLastButOne] = at_last_but_one;
  substitute_back(factors, one, rhs);
  return kept;
}

}  // namespace fencepost::recon
