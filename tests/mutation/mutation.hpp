// The switch of mutants that mutate.py writes into sources: all of them are in one build, FENCEPOST_MUTANT chooses one.
#pragma once

#include <type_traits>

namespace fencepost::mutation {

inline constexpr int kMax = 1 << 15;  // mutate.py refuses more
extern int chosen;
extern unsigned char reached[kMax];

/// Notes that mutant `id` was reached, and answers whether it is the chosen one. What is computed while compiling stays
/// as it is.
constexpr bool on(int id) noexcept {
  if (__builtin_is_constant_evaluated()) return false;
  reached[id] |= 1;
  return id == chosen;
}

/// A sum whose difference is of another type (Eigen's expressions, two pointers) stays as it is, and is no mutant.
template <class A, class B>
concept Interchangeable = requires(const A& a, const B& b) {
  requires std::is_same_v<decltype(a + b), decltype(a - b)>;
};

constexpr void none_here(int id) noexcept {
  if (!__builtin_is_constant_evaluated()) reached[id] |= 2;
}

// A comparison of vectors of the compiler's is a vector.
template <class A, class B>
constexpr auto lt(int id, const A& a, const B& b) noexcept -> decltype(a < b) {
  return on(id) ? a <= b : a < b;
}
template <class A, class B>
constexpr auto le(int id, const A& a, const B& b) noexcept -> decltype(a <= b) {
  return on(id) ? a < b : a <= b;
}
template <class A, class B>
constexpr auto gt(int id, const A& a, const B& b) noexcept -> decltype(a > b) {
  return on(id) ? a >= b : a > b;
}
template <class A, class B>
constexpr auto ge(int id, const A& a, const B& b) noexcept -> decltype(a >= b) {
  return on(id) ? a > b : a >= b;
}
template <class A, class B>
constexpr auto eq(int id, const A& a, const B& b) noexcept -> decltype(a == b) {
  return on(id) ? a != b : a == b;
}
template <class A, class B>
constexpr auto ne(int id, const A& a, const B& b) noexcept -> decltype(a != b) {
  return on(id) ? a == b : a != b;
}
template <class A, class B>
constexpr auto plus(int id, const A& a, const B& b) noexcept -> decltype(a + b) {
  if constexpr (Interchangeable<A, B>) {
    if (on(id)) return a - b;
  } else {
    none_here(id);
  }
  return a + b;
}
template <class A, class B>
constexpr auto minus(int id, const A& a, const B& b) noexcept -> decltype(a - b) {
  if constexpr (Interchangeable<A, B>) {
    if (on(id)) return a + b;
  } else {
    none_here(id);
  }
  return a - b;
}
template <class A>
constexpr auto negative(int id, const A& a) noexcept -> decltype(-a) {
  if constexpr (std::is_arithmetic_v<A>) {
    if (on(id)) return static_cast<decltype(-a)>(a);
  } else {
    none_here(id);
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
