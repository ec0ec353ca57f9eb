// Draws of one run, the same everywhere: the standard engine, our own distributions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>

namespace fencepost::test {

class Chance {
 public:
  explicit Chance(std::uint64_t seed) : engine_(seed * 0x9E3779B97F4A7C15ULL + 1) {}

  /// From low to high, both included.
  std::int64_t whole(std::int64_t low, std::int64_t high) {
    return low + static_cast<std::int64_t>(engine_() % static_cast<std::uint64_t>(high - low + 1));
  }
  double real(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11U) / 9007199254740992.0;
  }
  bool one_in(std::int64_t n) { return whole(1, n) == 1; }
  bool share(double probability) { return real(0, 1) < probability; }
  template <class Choices>
  const auto& of(const Choices& choices) {
    return choices[static_cast<std::size_t>(whole(0, static_cast<std::int64_t>(std::size(choices)) - 1))];
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace fencepost::test
