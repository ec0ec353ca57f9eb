// A small screen of coloured pixels, drawn row by row into a hidden picture, which is then shown at once.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

namespace fencepost::bus {

/// A colour of the palette, 8 bits each.
struct Colour {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;
  friend constexpr bool operator==(const Colour&, const Colour&) = default;
};

/// `kWidth` x `kHeight` pixels, each a number of the palette. No call waits.
/// `ready()`: there is a hidden picture; after show() there is none until the screen has changed over.
/// `put_row(y, pixels)`: kWidth of them, row 0 is the upper one. `set_colour(n, colour)` holds at once, for all pixels.
template <class T>
concept Screen = requires(T screen, const T& same, std::size_t n, std::span<const std::uint8_t> pixels, Colour colour) {
  { T::kWidth } -> std::convertible_to<std::size_t>;
  { T::kHeight } -> std::convertible_to<std::size_t>;
  { same.ready() } -> std::same_as<bool>;
  screen.put_row(n, pixels);
  screen.set_colour(n, colour);
  screen.show();
};

}  // namespace fencepost::bus
