#include "host/report/label_space.hpp"

#include <algorithm>
#include <cmath>

namespace fencepost::host {
namespace {

constexpr double kLine = 16;       ///< px
constexpr double kLetter = 7.6;    ///< px, mean width of the drawing's bold text
constexpr int kFarthest = 4;       ///< lines
constexpr double kSideMargin = 4;  ///< px

}  // namespace

double LabelSpace::place(double x, double y, std::string_view text, int direction) {
  Taken label{x, y, static_cast<double>(text.size()) * kLetter / 2 + kSideMargin};
  for (int step = 0; step < kFarthest && !clear(label); ++step) label.y += direction * kLine;
  if (!clear(label)) label.y = y;
  taken_.push_back(label);
  return label.y;
}

bool LabelSpace::clear(const Taken& label) const {
  return std::none_of(taken_.begin(), taken_.end(), [&](const Taken& other) {
    return std::abs(other.y - label.y) < kLine - 1 && std::abs(other.x - label.x) < other.half_width + label.half_width;
  });
}

}  // namespace fencepost::host
