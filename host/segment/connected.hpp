// Connected parts of an image, by union of neighbours.
#pragma once

#include <cstddef>
#include <numeric>
#include <vector>

namespace fencepost::host {

/// Number of the part of each pixel, row by row: parts count from 0 in the order of their first pixels. Neighbours a
/// and b (indices) belong together where same(a, b); `diagonal`: eight neighbours instead of four.
template <class Same>
std::vector<int> connected_parts(int rows, int columns, bool diagonal, Same same) {
  std::vector<int> root(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns));
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int at) {
    const auto parent = [&](int of) -> int& { return root[static_cast<std::size_t>(of)]; };
    while (parent(at) != at) at = parent(at) = parent(parent(at));
    return at;
  };
  const auto join = [&](int a, int b) {
    if (!same(static_cast<std::size_t>(a), static_cast<std::size_t>(b))) return;
    const int first = find(a);
    const int second = find(b);
    root[static_cast<std::size_t>(first < second ? second : first)] = first < second ? first : second;
  };
  for (int v = 0; v < rows; ++v) {
    for (int u = 0; u < columns; ++u) {
      const int here = v * columns + u;
      if (u > 0) join(here - 1, here);
      if (v == 0) continue;
      join(here - columns, here);
      if (diagonal && u > 0) join(here - columns - 1, here);
      if (diagonal && u + 1 < columns) join(here - columns + 1, here);
    }
  }
  // A part's root is its first pixel, so its number is known when the others come.
  int parts = 0;
  std::vector<int> number(root.size());
  for (std::size_t i = 0; i < root.size(); ++i) {
    const auto first = static_cast<std::size_t>(find(static_cast<int>(i)));
    number[i] = first == i ? parts++ : number[first];
  }
  return number;
}

}  // namespace fencepost::host
