// A symmetric positive system in which each unknown of a ring is coupled to its two neighbours on either side.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace fencepost::recon {

/// Unknowns around the circle.
inline constexpr std::size_t kRing = 64;
inline constexpr std::size_t kLastButOne = kRing - 2;  ///< the first of the two unknowns that close the ring
inline constexpr std::size_t kLast = kRing - 1;        ///< the second one

/// L D L' in place; the last two unknowns close the ring and are carried along as two dense columns. About 50 flops an
/// unknown in all. Rows are eliminated one by one, so that the work can be cut anywhere.
struct CyclicBand {
  using Column = std::array<float, kRing>;

  Column diagonal{};      ///< A(k, k)
  Column first{};         ///< A(k, k + 1), indices modulo kRing
  Column second{};        ///< A(k, k + 2)
  Column rhs{};           ///< becomes the solution
  Column last_but_one{};  ///< scratch: column kRing - 2 of the rows above it
  Column last{};          ///< scratch: column kRing - 1

  void clear() {
    diagonal.fill(0);
    first.fill(0);
    second.fill(0);
    rhs.fill(0);
  }

  /// Before the first row.
  void begin_elimination();
  /// Row k = 0 .. kRing - 1, in this order. False: a pivot is lost to rounding, the system is
  /// ill-conditioned.
  [[nodiscard]] bool eliminate(std::size_t k);
  /// Row k = kRing - 1 .. 0, in this order: rhs[k] becomes the unknown.
  void substitute(std::size_t k);

 private:
  // Diagonals of the rows ahead before anything is taken from them.
  float original_ = 0;
  float original_next_ = 0;
  float original_last_but_one_ = 0;
  float original_last_ = 0;
};

}  // namespace fencepost::recon
