// A symmetric positive system in which each unknown of a ring is coupled to its two neighbours on either side.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/recon/models/hybrid/lanes.hpp"

namespace fencepost::recon {

/// Unknowns around the circle.
inline constexpr std::size_t kRing = 64;

/// L D L' in place; the last two unknowns close the ring and are carried along as two dense columns. About 50 flops an
/// unknown in all. Rows are eliminated one by one, so that the work can be cut anywhere. Number: float, or Lanes for as
/// many systems at once.
template <class Number>
struct CyclicBandOf {
  using Column = std::array<Number, kRing>;

  Column diagonal{};      ///< A(k, k)
  Column first{};         ///< A(k, k + 1), indices modulo kRing
  Column second{};        ///< A(k, k + 2)
  Column rhs{};           ///< becomes the solution
  Column last_but_one{};  ///< scratch: column kRing - 2 of the rows above it
  Column last{};          ///< scratch: column kRing - 1

  void clear() {
    diagonal.fill(Number{});
    first.fill(Number{});
    second.fill(Number{});
    rhs.fill(Number{});
  }

  /// Before the first row.
  void begin_elimination();
  /// Row k = 0 .. kRing - 1, in this order. False, for lanes 0: a pivot is lost to rounding, the system is
  /// ill-conditioned.
  [[nodiscard]] Kept<Number> eliminate(std::size_t k);
  /// Row k = kRing - 1 .. 0, in this order: rhs[k] becomes the unknown.
  void substitute(std::size_t k);

 private:
  // Diagonals of the rows ahead before anything is taken from them.
  Number original_{};
  Number original_next_{};
  Number original_last_but_one_{};
  Number original_last_{};
};

using CyclicBand = CyclicBandOf<float>;
extern template struct CyclicBandOf<float>;

}  // namespace fencepost::recon
