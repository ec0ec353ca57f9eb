// The switch of mutants that mutate.py writes into sources: all of them are in one build, FENCEPOST_MUTANT chooses one.
#pragma once

#include <type_traits>

namespace fencepost::mutation {

/// Notes that mutant `id` was reached, and answers whether it is the chosen one.
bool reached_and_chosen(int id) noexcept;

/// What is computed while compiling stays as it is.
constexpr bool on(int id) noexcept {
  if (__builtin_is_constant_evaluated()) return false;
  return reached_and_chosen(id);
}

template <class A, class B>
inline constexpr bool kScalars = std::is_arithmetic_v<A>&& std::is_arithmetic_v<B>;

template <class A, class B>
constexpr bool lt(int id, const A& a, const B& b) noexcept {
  return on(id) ? a <= b : a < b;
}
template <class A, class B>
constexpr bool le(int id, const A& a, const B& b) noexcept {
  return on(id) ? a < b : a <= b;
}
template <class A, class B>
constexpr bool gt(int id, const A& a, const B& b) noexcept {
  return on(id) ? a >= b : a > b;
}
template <class A, class B>
constexpr bool ge(int id, const A& a, const B& b) noexcept {
  return on(id) ? a > b : a >= b;
}
template <class A, class B>
constexpr bool eq(int id, const A& a, const B& b) noexcept {
  return on(id) ? a != b : a == b;
}
template <class A, class B>
constexpr bool ne(int id, const A& a, const B& b) noexcept {
  return on(id) ? a == b : a != b;
}
// Vectors stay as they are: their sums are expressions that differ in type.
template <class A, class B>
constexpr auto plus(int id, const A& a, const B& b) noexcept -> decltype(a + b) {
  if constexpr (kScalars<A, B>) {
    if (on(id)) return static_cast<decltype(a + b)>(a - b);
  }
  return a + b;
}
template <class A, class B>
constexpr auto minus(int id, const A& a, const B& b) noexcept -> decltype(a - b) {
  if constexpr (kScalars<A, B>) {
    if (on(id)) return static_cast<decltype(a - b)>(a + b);
  }
  return a - b;
}
template <class A>
constexpr auto negative(int id, const A& a) noexcept -> decltype(-a) {
  if constexpr (std::is_arithmetic_v<A>) {
    if (on(id)) return static_cast<decltype(-a)>(a);
  }
  return -a;
}
template <class A>
constexpr bool negated(int id, const A& a) noexcept {
  return on(id) ? static_cast<bool>(a) : !static_cast<bool>(a);
}
/// Integers one more, others a tenth more.
template <class A>
constexpr A constant(int id, A a) noexcept {
  if constexpr (std::is_integral_v<A>) {
    return on(id) ? static_cast<A>(a + 1) : a;
  } else {
    return on(id) ? static_cast<A>(a * A(1.1) + (a == A(0) ? A(0.1) : A(0))) : a;
  }
}

}  // namespace fencepost::mutation
