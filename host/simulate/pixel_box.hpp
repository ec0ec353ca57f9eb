// A box of whole pixels.
#pragma once

#include <algorithm>

namespace fencepost::host {

/// Inclusive pixel box; empty when x1 > x2.
struct PixelBox {
  int x1 = 1;
  int y1 = 1;
  int x2 = 0;
  int y2 = 0;
  [[nodiscard]] bool empty() const { return x1 > x2; }
  void include(int u, int v) {
    if (empty()) {
      *this = {u, v, u, v};
      return;
    }
    x1 = std::min(x1, u);
    y1 = std::min(y1, v);
    x2 = std::max(x2, u);
    y2 = std::max(y2, v);
  }
  [[nodiscard]] bool contains(int u, int v) const { return u >= x1 && u <= x2 && v >= y1 && v <= y2; }
  /// They share a pixel, or pixels of them are neighbours, over a corner too.
  [[nodiscard]] bool touches(const PixelBox& other) const {
    return !empty() && !other.empty() && x1 <= other.x2 + 1 && other.x1 <= x2 + 1 && y1 <= other.y2 + 1 &&
           other.y1 <= y2 + 1;
  }
};

}  // namespace fencepost::host
