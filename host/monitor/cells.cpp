#include "host/monitor/cells.hpp"

#include <algorithm>

namespace fencepost::host::monitor {
namespace {

bool continues(char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U; }

std::string sequence(const Style& style) {
  std::string codes = "0";
  if (style.bold) codes += ";1";
  if (style.dim) codes += ";2";
  if (style.ink != Ink::kDefault) codes += ";3" + std::to_string(static_cast<int>(style.ink));
  if (style.paper != Ink::kDefault) codes += ";4" + std::to_string(static_cast<int>(style.paper));
  return "\x1b[" + codes + "m";
}

}  // namespace

std::size_t length(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count_if(text, [](char byte) { return !continues(byte); }));
}

Cells::Cell* Cells::at(std::size_t row, std::size_t column) {
  return row < size_.rows && column < size_.columns ? &cells_[row * size_.columns + column] : nullptr;
}

std::size_t Cells::put(std::size_t row, std::size_t column, std::string_view text, Style style) {
  while (!text.empty()) {
    std::size_t bytes = 1;
    while (bytes < text.size() && continues(text[bytes])) ++bytes;
    if (Cell* const cell = at(row, column)) *cell = {std::string(text.substr(0, bytes)), style};
    text.remove_prefix(bytes);
    ++column;
  }
  return column;
}

void Cells::put_right(std::size_t row, std::size_t start, std::size_t end, std::string_view text, Style style) {
  const std::size_t wide = length(text);
  put(row, end > start + wide ? end - wide : start, text, style);
}

void Cells::fill(std::size_t row, std::size_t start, std::size_t end, Style style) {
  for (std::size_t column = start; column < end; ++column) mark(row, column, ' ', style);
}

void Cells::mark(std::size_t row, std::size_t column, char character, Style style) {
  if (Cell* const cell = at(row, column)) *cell = {std::string(1, character), style};
}

std::string Cells::row(std::size_t row, bool colour) const {
  std::size_t used = size_.columns;
  const Cell* const first = &cells_[row * size_.columns];
  while (used > 0 && first[used - 1].character == " " && (!colour || first[used - 1].style == Style{})) --used;
  std::string text;
  Style style;
  for (std::size_t column = 0; column < used; ++column) {
    if (colour && first[column].style != style) text += sequence(style = first[column].style);
    text += first[column].character;
  }
  return style == Style{} ? text : text + "\x1b[0m";
}

}  // namespace fencepost::host::monitor
