// Two pages of simulated flash whose power can be cut in the middle of any write.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/bus/flash_pages.hpp"

namespace fencepost::fake {

/// Flash as parts have it: erased bytes are 0xFF, writing clears bits. After `cut_after(n)`, n words are still written
/// (an erasure counts as one). Of the next word some bits are written, or none if it is not torn. From then on nothing
/// is written until power_on().
template <std::size_t N>
class CutFlash {
 public:
  CutFlash() { pages_[0].fill(0xFF), pages_[1].fill(0xFF); }

  [[nodiscard]] std::size_t size() const { return N; }
  [[nodiscard]] std::span<const std::uint8_t> page(std::size_t n) const { return pages_[n]; }

  bool program(std::size_t n, std::size_t offset, std::span<const std::uint8_t> bytes) {
    bool right = true;
    for (std::size_t i = 0; i < bytes.size(); i += bus::kFlashWord) {
      const Step step = next();
      for (std::size_t k = i; k < i + bus::kFlashWord; ++k) {
        std::uint8_t& cell = pages_[n][offset + k];
        if (step == Step::kWhole) cell = static_cast<std::uint8_t>(cell & bytes[k]);
        if (step == Step::kHalf) cell = static_cast<std::uint8_t>(cell & (bytes[k] | noise()));
        right = right && cell == bytes[k];
      }
    }
    return right;
  }

  bool erase(std::size_t n) {
    ++erasures_;
    const Step step = next();
    if (step == Step::kWhole) pages_[n].fill(0xFF);
    if (step == Step::kHalf) {
      for (std::uint8_t& cell : pages_[n]) cell = static_cast<std::uint8_t>(cell | noise());
    }
    return step == Step::kWhole;
  }

  void cut_after(std::size_t words, bool torn = true) { left_ = words, torn_ = torn, limited_ = true, dead_ = false; }
  void power_on() { limited_ = dead_ = false; }
  /// Whether the cut has come.
  [[nodiscard]] bool dead() const { return dead_; }
  [[nodiscard]] std::size_t erasures() const { return erasures_; }

 private:
  enum class Step : std::uint8_t { kWhole, kHalf, kNone };

  Step next() {
    if (dead_) return Step::kNone;
    if (!limited_ || left_-- > 0) return Step::kWhole;
    dead_ = true;
    return torn_ ? Step::kHalf : Step::kNone;
  }
  // Numerical Recipes' generator chooses which bits were written.
  std::uint8_t noise() {
    random_ = random_ * 1'664'525U + 1'013'904'223U;
    return static_cast<std::uint8_t>(random_ >> 24U);
  }

  std::array<std::array<std::uint8_t, N>, 2> pages_{};
  std::size_t left_ = 0;
  bool limited_ = false;
  bool torn_ = true;
  bool dead_ = false;
  std::size_t erasures_ = 0;
  std::uint32_t random_ = 1;
};

static_assert(bus::FlashPages<CutFlash<64>>);

}  // namespace fencepost::fake
