// Containers of fixed capacity. Full is a returned value, never a crash and never an allocation.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>

#include "hal/base/check.hpp"

namespace fencepost::base {

/// The smallest unsigned type that holds 0..N: with 16 KB of RAM, an eight-byte count of four items is a waste.
template <std::size_t N>
using CountFor =
    std::conditional_t<(N <= 0xFF), std::uint8_t, std::conditional_t<(N <= 0xFFFF), std::uint16_t, std::uint32_t>>;

/// A vector of at most N elements, stored in place. T is trivially destructible and default constructible.
template <class T, std::size_t N>
class FixedVector {
 public:
  static constexpr std::size_t capacity() { return N; }
  [[nodiscard]] constexpr std::size_t size() const { return size_; }
  [[nodiscard]] constexpr bool empty() const { return size_ == 0; }
  [[nodiscard]] constexpr bool full() const { return size_ == N; }

  /// False, and nothing stored, when full.
  [[nodiscard]] constexpr bool push_back(const T& item) {
    if (full()) return false;
    items_[size_] = item;
    size_ = static_cast<CountFor<N>>(size_ + 1);
    return true;
  }
  constexpr void clear() { size_ = 0; }
  constexpr void pop_back() {
    FENCEPOST_CHECK(size_ > 0);
    size_ = static_cast<CountFor<N>>(size_ - 1);
  }
  /// Keeps the order of the others.
  constexpr void erase_at(std::size_t index) {
    FENCEPOST_CHECK(index < size_);
    for (std::size_t i = index + 1; i < size_; ++i) items_[i - 1] = items_[i];
    size_ = static_cast<CountFor<N>>(size_ - 1);
  }
  constexpr void truncate(std::size_t size) {
    FENCEPOST_CHECK(size <= size_);
    size_ = static_cast<CountFor<N>>(size);
  }

  constexpr T& operator[](std::size_t i) {
    FENCEPOST_CHECK(i < size_);
    return items_[i];
  }
  constexpr const T& operator[](std::size_t i) const {
    FENCEPOST_CHECK(i < size_);
    return items_[i];
  }
  constexpr T* begin() { return items_.data(); }
  constexpr T* end() { return items_.data() + size_; }
  constexpr const T* begin() const { return items_.data(); }
  constexpr const T* end() const { return items_.data() + size_; }
  [[nodiscard]] constexpr std::span<const T> view() const { return {items_.data(), size_}; }

  friend constexpr bool operator==(const FixedVector& a, const FixedVector& b) {
    if (a.size_ != b.size_) return false;
    for (std::size_t i = 0; i < a.size_; ++i) {
      if (!(a.items_[i] == b.items_[i])) return false;
    }
    return true;
  }

 private:
  std::array<T, N> items_{};
  CountFor<N> size_ = 0;
};

/// A first-in first-out queue of at most N elements; index 0 is the oldest.
template <class T, std::size_t N>
class Ring {
 public:
  static constexpr std::size_t capacity() { return N; }
  [[nodiscard]] constexpr std::size_t size() const { return size_; }
  [[nodiscard]] constexpr bool empty() const { return size_ == 0; }
  [[nodiscard]] constexpr bool full() const { return size_ == N; }

  /// False, and nothing stored, when full.
  [[nodiscard]] constexpr bool push_back(const T& item) {
    if (full()) return false;
    items_[slot(size_)] = item;
    size_ = static_cast<CountFor<N>>(size_ + 1);
    return true;
  }
  /// Makes room by dropping the oldest.
  constexpr void push_over_oldest(const T& item) {
    if (full()) pop_front();
    items_[slot(size_)] = item;
    size_ = static_cast<CountFor<N>>(size_ + 1);
  }
  constexpr void pop_front() {
    FENCEPOST_CHECK(size_ > 0);
    head_ = static_cast<CountFor<N>>(slot(1));
    size_ = static_cast<CountFor<N>>(size_ - 1);
  }
  constexpr void clear() { head_ = size_ = 0; }

  constexpr T& operator[](std::size_t i) {
    FENCEPOST_CHECK(i < size_);
    return items_[slot(i)];
  }
  constexpr const T& operator[](std::size_t i) const {
    FENCEPOST_CHECK(i < size_);
    return items_[slot(i)];
  }
  [[nodiscard]] constexpr const T& front() const { return (*this)[0]; }
  [[nodiscard]] constexpr const T& back() const { return (*this)[size_ - 1U]; }

 private:
  /// No remainder operation: i is at most N, and division is a loop on small cores.
  [[nodiscard]] constexpr std::size_t slot(std::size_t i) const {
    const std::size_t at = head_ + i;
    return at < N ? at : at - N;
  }

  std::array<T, N> items_{};
  CountFor<N> head_ = 0;
  CountFor<N> size_ = 0;
};

/// A string of at most N characters.
template <std::size_t N>
class FixedString {
 public:
  constexpr FixedString() = default;
  /// Cuts what does not fit.
  constexpr FixedString(std::string_view text)  // NOLINT(google-explicit-constructor)
      : size_(static_cast<CountFor<N>>(text.size() < N ? text.size() : N)) {
    for (std::size_t i = 0; i < size_; ++i) characters_[i] = text[i];
  }
  constexpr FixedString(const char* text) : FixedString(std::string_view(text)) {}  // NOLINT

  [[nodiscard]] constexpr std::string_view view() const { return {characters_.data(), size_}; }
  [[nodiscard]] constexpr bool empty() const { return size_ == 0; }
  [[nodiscard]] constexpr bool push_back(char c) {
    if (size_ == N) return false;
    characters_[size_] = c;
    size_ = static_cast<CountFor<N>>(size_ + 1);
    return true;
  }
  friend constexpr bool operator==(const FixedString& a, const FixedString& b) { return a.view() == b.view(); }

 private:
  std::array<char, N> characters_{};
  CountFor<N> size_ = 0;
};

/// The number of slots of a table up to the last one in use: most are free at its end, where nothing needs to look.
template <class Slots>
[[nodiscard]] constexpr std::size_t slots_in_use(const Slots& slots) {
  std::size_t in_use = slots.size();
  while (in_use > 0 && !slots[in_use - 1].used()) --in_use;
  return in_use;
}

}  // namespace fencepost::base
