// Cholesky's factor of a small symmetric matrix, of which the lower triangle is kept by rows, (0,0) (1,0) (1,1) and on.
// Number: float, or a vector of floats for as many matrices at once, of which each lane has the bits of a float.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <type_traits>
#include <utility>

#include "firmware/recon/models/hybrid/tuning.hpp"

namespace fencepost::recon {

/// Whether a pivot is kept: bool; of vectors, by lane, -1 or 0.
template <class Number>
using Kept = decltype(std::declval<Number>() > std::declval<Number>());

/// Square root, by lane.
template <class Number>
Number root(Number x) {
  if constexpr (std::is_same_v<Number, float>) {
    return std::sqrt(x);
  } else {
    for (std::size_t lane = 0; lane < sizeof x / sizeof(float); ++lane) x[lane] = std::sqrt(x[lane]);
    return x;
  }
}

/// Where row i begins.
constexpr std::size_t row_of(std::size_t i) { return i * (i + 1) / 2; }

/// Row i is replaced by that of the factor; those before it have been. False, of a lane 0: a pivot is lost to rounding.
/// Lanes always go on: one that is lost has no meaning.
template <class Number>
Kept<Number> factorise_triangle_row(std::span<Number> matrix, std::size_t i) {
  Number* row = &matrix[row_of(i)];
  const Number diagonal = row[i];
  for (std::size_t j = 0; j < i; ++j) {
    const Number* other = &matrix[row_of(j)];
    for (std::size_t k = 0; k < j; ++k) row[j] -= row[k] * other[k];
    row[j] /= other[j];
    row[i] -= row[j] * row[j];
  }
  const Kept<Number> kept = row[i] > kMinPivot * diagonal;
  if constexpr (std::is_same_v<Number, float>) {
    if (!kept) return kept;
  }
  row[i] = root(row[i]);
  return kept;
}

/// L x = b, in place; one factor for all lanes of b, or each its own.
template <class Factor, class Number>
void solve_lower_triangle(std::span<const Factor> factor, std::span<Number> b) {
  for (std::size_t i = 0; i < b.size(); ++i) {
    const Factor* row = &factor[row_of(i)];
    for (std::size_t k = 0; k < i; ++k) b[i] -= row[k] * b[k];
    b[i] /= row[i];
  }
}

/// L' x = b, in place.
template <class Factor, class Number>
void solve_upper_triangle(std::span<const Factor> factor, std::span<Number> b) {
  for (std::size_t i = b.size(); i-- > 0;) {
    const Factor* row = &factor[row_of(i)];
    b[i] /= row[i];
    for (std::size_t k = 0; k < i; ++k) b[k] -= row[k] * b[i];
  }
}

}  // namespace fencepost::recon
