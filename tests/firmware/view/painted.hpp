// A screen in memory, as rows of characters.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "firmware/view/shapes.hpp"
#include "hal/bus/screen.hpp"

namespace fencepost::test {

/// The rows of `width` x `height` pixels that `paint` has painted: '#' where it did. "outside": it left its row.
template <class Paint>
std::vector<std::string> painted(std::size_t width, std::size_t height, Paint&& paint) {
  std::vector<std::string> rows;
  for (std::size_t y = 0; y < height; ++y) {
    std::vector<std::uint8_t> pixels(width + 2, 0);  // one too many on either side: nobody may write there
    const std::span<std::uint8_t> inside(pixels.data() + 1, width);
    view::Row row(inside, static_cast<std::int32_t>(y));
    paint(row);
    std::string text;
    for (const std::uint8_t pixel : pixels) text += pixel == 0 ? '.' : '#';
    rows.push_back(text.front() == '.' && text.back() == '.' ? text.substr(1, width) : "outside");
  }
  return rows;
}

class FakeScreen {
 public:
  static constexpr std::size_t kWidth = 240;
  static constexpr std::size_t kHeight = 160;

  [[nodiscard]] bool ready() const { return ready_; }
  void put_row(std::size_t y, std::span<const std::uint8_t> pixels) {
    for (std::size_t x = 0; x < kWidth; ++x) hidden_[y][x] = pixels[x];
    ++rows_put;
  }
  void set_colour(std::size_t n, bus::Colour colour) { palette_[n] = colour; }
  void show() {
    shown_ = hidden_;
    ++pictures;
    ready_ = !slow;
  }
  void change_over() { ready_ = true; }
  [[nodiscard]] bus::Colour at(std::size_t x, std::size_t y) const { return palette_[shown_[y][x]]; }

  int pictures = 0;
  int rows_put = 0;
  bool slow = false;  ///< show() takes until change_over()

 private:
  using Page = std::array<std::array<std::uint8_t, kWidth>, kHeight>;
  Page hidden_{};
  Page shown_{};
  std::array<bus::Colour, 256> palette_{};
  bool ready_ = true;
};
static_assert(bus::Screen<FakeScreen>);

}  // namespace fencepost::test
