// A screen as cells: text that is put beyond its edges is cut off, never wrapped.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace fencepost::host::monitor {

enum class Ink : std::uint8_t { kBlack, kRed, kGreen, kYellow, kBlue, kMagenta, kCyan, kWhite, kDefault };

struct Style {
  Ink ink = Ink::kDefault;
  Ink paper = Ink::kDefault;
  bool bold = false;
  bool dim = false;
  friend bool operator==(const Style&, const Style&) = default;
};

struct Size {
  std::size_t columns = 80;
  std::size_t rows = 24;
  friend bool operator==(const Size&, const Size&) = default;
};

class Cells {
 public:
  explicit Cells(Size size) : size_(size), cells_(size.columns * size.rows) {}

  [[nodiscard]] Size size() const { return size_; }
  /// UTF-8, a cell a character. The column behind it.
  std::size_t put(std::size_t row, std::size_t column, std::string_view text, Style style = {});
  /// So that it ends before `end`; begins at `start` at the earliest.
  void put_right(std::size_t row, std::size_t start, std::size_t end, std::string_view text, Style style = {});
  void fill(std::size_t row, std::size_t start, std::size_t end, Style style);
  void mark(std::size_t row, std::size_t column, char character, Style style = {});

  /// A row without blanks at its end. `colour`: with escape sequences for its styles, none in force behind it.
  [[nodiscard]] std::string row(std::size_t row, bool colour) const;

 private:
  struct Cell {
    std::string character = " ";
    Style style;
  };
  [[nodiscard]] Cell* at(std::size_t row, std::size_t column);

  Size size_;
  std::vector<Cell> cells_;
};

/// Characters of UTF-8.
std::size_t length(std::string_view text);

}  // namespace fencepost::host::monitor
