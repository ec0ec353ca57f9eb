// Two pages of flash memory for settings that have to survive a reset.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

namespace fencepost::bus {

/// Smallest write unit and its alignment, bytes. One word suits all families here.
inline constexpr std::size_t kFlashWord = 4;

/// Pages 0 and 1, of `size()` bytes each, a multiple of kFlashWord. Erased flash reads 0xFF, and writing only clears
/// bits. `page(n)` is what is there now.
/// `program(n, offset, bytes)`: offset and length are multiples of kFlashWord, words in rising order, each once after
/// an erasure. `erase(n)` makes it all 0xFF. Both wait for the part, bounded, and answer whether the page now holds
/// what it should. After a power cut any subset of the pending words may be missing and one may be half written.
template <class T>
concept FlashPages = requires(T flash, const T& same, std::size_t n, std::span<const std::uint8_t> bytes) {
  { same.size() } -> std::same_as<std::size_t>;
  { same.page(n) } -> std::same_as<std::span<const std::uint8_t>>;
  { flash.program(n, n, bytes) } -> std::same_as<bool>;
  { flash.erase(n) } -> std::same_as<bool>;
};

}  // namespace fencepost::bus
