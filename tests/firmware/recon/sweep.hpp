// Answers over many inputs, one digest for each name. Inputs are drawn from a grid so coarse that they often meet a
// bound exactly. A `<` that becomes `<=`, a condition left out or another constant therefore changes the digest. It is
// for values that were measured or chosen and have no other truth; where there is one, a test says it in words.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <initializer_list>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

#include "hal/base/fnv1a.hpp"

namespace fencepost::test {

/// The same numbers everywhere: of a distribution the standard library's differ.
class Draw {
 public:
  explicit Draw(std::uint32_t seed) : random_(seed) {}

  /// Both included.
  template <class T>
  T between(T low, T high) {
    return static_cast<T>(low + static_cast<T>(random_() % static_cast<std::uint32_t>(high - low + 1)));
  }
  bool coin() { return (random_() & 1U) != 0; }
  bool one_in(std::uint32_t n) { return random_() % n == 0; }
  template <class T>
  T of(std::initializer_list<T> values) {
    return values.begin()[random_() % values.size()];
  }
  /// A multiple of `step`, both ends included.
  float steps(int low, int high, float step) { return static_cast<float>(between(low, high)) * step; }

 private:
  std::mt19937 random_;
};

/// The values recorded under each name: the number that were not zero, and a digest of all in their order.
class Sweep {
 public:
  template <class T>
  void tell(const char* name, T value) {
    Told& told = of(name);
    told.some += value != T{} ? 1 : 0;
    base::Fnv1a64 hash(told.digest);
    if constexpr (std::is_floating_point_v<T>) {
      hash.f32(value == 0 ? 0.0F : value);
    } else {
      hash.i64(static_cast<std::int64_t>(value));
    }
    told.digest = hash.value();
  }
  /// Lines of "name some digest".
  [[nodiscard]] std::vector<std::string> said() const {
    std::vector<std::string> lines;
    for (const Told& told : all_) {
      char text[96];
      std::snprintf(text, sizeof text, "%s %d %08x", told.name.c_str(), told.some,
                    static_cast<unsigned>(told.digest ^ told.digest >> 32U));
      lines.emplace_back(text);
    }
    return lines;
  }

 private:
  struct Told {
    std::string name;
    int some = 0;
    std::uint64_t digest = base::Fnv1a64::kOffsetBasis;
  };
  Told& of(const char* name) {
    for (Told& told : all_) {
      if (told.name == name) return told;
    }
    all_.push_back({name});
    return all_.back();
  }

  std::vector<Told> all_;
};

/// Compares each line by itself, so that a failure names the answer that has changed.
inline void expect_said(const Sweep& sweep, const std::vector<std::string>& lines) {
  const std::vector<std::string> said = sweep.said();
  EXPECT_EQ(said.size(), lines.size());
  for (std::size_t i = 0; i < said.size(); ++i)
    EXPECT_EQ("\"" + said[i] + "\",", i < lines.size() ? "\"" + lines[i] + "\"," : "");
}

}  // namespace fencepost::test
