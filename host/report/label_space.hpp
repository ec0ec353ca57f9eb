// Keeps labels from overlapping.
#pragma once

#include <string_view>
#include <vector>

namespace fencepost::host {

class LabelSpace {
 public:
  /// The baseline for a centred label at (x, y) px: y itself, or moved by steps of a line (`direction` -1 up, +1 down)
  /// until it is clear of the labels before it. After a few steps it stays: overlapping is better than too far away.
  double place(double x, double y, std::string_view text, int direction);

 private:
  struct Taken {
    double x;
    double y;
    double half_width;
  };
  [[nodiscard]] bool clear(const Taken& label) const;
  std::vector<Taken> taken_;
};

}  // namespace fencepost::host
