#include "firmware/recon/guard/seen_floor.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "firmware/recon/floor_frame.hpp"

namespace fencepost::recon::guard {
namespace {

constexpr std::int32_t kUnitsPerMm = kMapUnitsPerMetre / 1000;
// mm from a border beyond which a cell's centre has the whole cell inside: more than half of its diagonal.
constexpr std::int32_t kCellMargin = kFloorCell * 3 / 4;

// The part of the floor that an image shows: between its columns, and by strips of them up to the nearest foot.
class View {
 public:
  View(const WaitingFrame& frame, const CameraModel& camera) {
    const FloorCamera& floor = camera.floor;
    left_ = floor.leftmost_visible();
    right_ = floor.rightmost_visible();
    strip_ = std::max((left_ - right_) / kStrips, std::int32_t{1});
    // The ray of the lowest row falls from the lens's height to the floor; kMinHeight is reached at the same share.
    const auto height = nearest_whole(kMillimetresPerMetre * camera.height);
    nearest_ = floor.nearest_visible();
    if (height > 0) nearest_ -= nearest_ * std::min(kMinHeight, height) / height;
    ends_.fill(kFloorReach);
    for (const WaitingBlob& blob : frame.blobs) hide_behind(blob, floor);
  }

  [[nodiscard]] bool shows(const FloorPlace& place) const {
    if (place.depth < nearest_ || place.depth > kFloorReach) return false;
    if (place.left > times(place.depth, left_) - kCellMargin) return false;
    if (place.left < times(place.depth, right_) + kCellMargin) return false;
    return place.depth <= ends_[strip_of((place.left << kSlopeBits) / place.depth)];
  }
  [[nodiscard]] std::int32_t left() const { return left_; }
  [[nodiscard]] std::int32_t right() const { return right_; }

 private:
  static constexpr std::int32_t kStrips = 32;

  [[nodiscard]] std::size_t strip_of(std::int32_t slope) const {
    return static_cast<std::size_t>(std::clamp((slope - right_) / strip_, std::int32_t{0}, kStrips - 1));
  }
  // A cell that is beside a blob's ray by less than its size may be behind it, too.
  void hide_behind(const WaitingBlob& blob, const FloorCamera& floor) {
    const auto [left, right] = floor.at(2 * blob.box.x1 - 1, 2 * blob.box.x2 + 1, 2 * blob.box.y2 + 1);
    const std::int32_t depth = std::min(left.depth, right.depth) - kCellMargin;
    if (depth > kFloorReach) return;
    const std::int32_t beside = kCellMargin * kSlopeOne / std::max(depth, kCellMargin);
    const std::size_t last = strip_of(left.slope + beside);
    for (std::size_t i = strip_of(right.slope - beside); i <= last; ++i) {
      ends_[i] = static_cast<std::int16_t>(std::min(std::int32_t{ends_[i]}, std::max(depth, std::int32_t{0})));
    }
  }

  std::array<std::int16_t, kStrips> ends_{};  ///< mm
  std::int32_t nearest_ = 0;
  std::int32_t left_ = 0;  ///< slopes
  std::int32_t right_ = 0;
  std::int32_t strip_ = 1;
};

// Cells, both ends included.
struct Range {
  std::int32_t low = 0;
  std::int32_t high = 0;
  void include(std::int32_t millimetres) {
    low = std::min(low, millimetres >> kFloorCellLog2);
    high = std::max(high, millimetres >> kFloorCellLog2);
  }
  void keep_within(std::int32_t first, std::int32_t count) {
    low = std::max(low, first);
    high = std::min(high, first + count - 1);
  }
};

constexpr std::uint64_t bit_of(std::int32_t cell) {
  return std::uint64_t{1} << (static_cast<std::uint32_t>(cell) % 64U);
}
constexpr std::size_t row_of(std::int32_t cell) { return static_cast<std::uint32_t>(cell) % 64U; }

}  // namespace

void SeenFloor::age(base::Time t) {
  if (has_looked_ && began_at_.since(t) < kFloorRemembered) return;
  before_ = now_;
  now_.fill(0);
  if (!has_looked_ || began_at_.since(t) >= kFloorRemembered + kFloorRemembered) before_.fill(0);
  began_at_ = base::Stamp(t);
}

// The robot stays in the middle; what enters at an edge was not seen.
void SeenFloor::follow(std::int32_t x, std::int32_t y) {
  const std::int32_t first_x = (x >> kFloorCellLog2) - kCells / 2;
  const std::int32_t first_y = (y >> kFloorCellLog2) - kCells / 2;
  const std::int32_t steps_x = std::clamp(first_x - first_x_, -kCells, kCells);
  const std::int32_t steps_y = std::clamp(first_y - first_y_, -kCells, kCells);
  std::uint64_t kept = ~std::uint64_t{0};
  for (std::int32_t i = 0; i < std::abs(steps_x); ++i) {
    kept &= ~bit_of(steps_x > 0 ? first_x + kCells - 1 - i : first_x + i);
  }
  for (std::int32_t i = 0; i < std::abs(steps_y); ++i) {
    const std::size_t row = row_of(steps_y > 0 ? first_y + kCells - 1 - i : first_y + i);
    now_[row] = before_[row] = 0;
  }
  if (steps_x != 0) {
    for (std::uint64_t& row : now_) row &= kept;
    for (std::uint64_t& row : before_) row &= kept;
  }
  first_x_ = first_x;
  first_y_ = first_y;
}

void SeenFloor::look(const WaitingFrame& frame, const CameraModel& camera, const MapPose& robot) {
  const base::Time t = frame.t - camera.latency;
  if (!camera.floor.usable() || frame.blobs.full()) return;
  if (has_looked_ && looked_at_.since(t) < kFloorInterval) return;
  age(t);
  has_looked_ = true;
  looked_at_ = base::Stamp(t);
  const LensPose pose = lens_pose(robot, camera);
  FloorFrame lens;
  const std::int32_t robot_x = pose.anchor.x / kUnitsPerMm;
  const std::int32_t robot_y = pose.anchor.y / kUnitsPerMm;
  follow(robot_x, robot_y);
  lens.x = robot_x + nearest_whole(kMillimetresPerMetre * pose.lens.x(), 4000);
  lens.y = robot_y + nearest_whole(kMillimetresPerMetre * pose.lens.y(), 4000);
  lens.axis_x = nearest_whole(static_cast<float>(kSlopeOne) * pose.axis.x());
  lens.axis_y = nearest_whole(static_cast<float>(kSlopeOne) * pose.axis.y());

  const View view(frame, camera);
  // The box around the lens and the two farthest places.
  Range xs{lens.x >> kFloorCellLog2, lens.x >> kFloorCellLog2};
  Range ys{lens.y >> kFloorCellLog2, lens.y >> kFloorCellLog2};
  for (const std::int32_t slope : {view.left(), view.right()}) {
    const std::int32_t left = times(kFloorReach, slope);
    xs.include(lens.x + times(kFloorReach, lens.axis_x) - times(left, lens.axis_y));
    ys.include(lens.y + times(kFloorReach, lens.axis_y) + times(left, lens.axis_x));
  }
  xs.keep_within(first_x_, kCells);
  ys.keep_within(first_y_, kCells);
  for (std::int32_t y = ys.low; y <= ys.high; ++y) {
    std::uint64_t shown = 0;
    const std::int32_t dx = xs.low * kFloorCell + kFloorCell / 2 - lens.x;  // to the centre of the row's first cell
    const std::int32_t dy = y * kFloorCell + kFloorCell / 2 - lens.y;
    std::int32_t depth = lens.axis_x * dx + lens.axis_y * dy;
    std::int32_t left = lens.axis_x * dy - lens.axis_y * dx;
    for (std::int32_t x = xs.low; x <= xs.high; ++x) {
      if (view.shows({depth >> kSlopeBits, left >> kSlopeBits})) shown |= bit_of(x);
      depth += lens.axis_x * kFloorCell;
      left -= lens.axis_y * kFloorCell;
    }
    now_[row_of(y)] |= shown;
  }
}

bool SeenFloor::holds(std::int32_t x, std::int32_t y) const {
  return x >= first_x_ && x < first_x_ + kCells && y >= first_y_ && y < first_y_ + kCells;
}

std::int32_t SeenFloor::seen_along(const FloorFrame& ray, std::int32_t first, std::int32_t step) const {
  if (!has_looked_) return 0;
  constexpr int kCellBits = kSlopeBits + kFloorCellLog2;
  // Places from the grid's first cell, which is never far: so they fit with the bits of a direction.
  const std::int32_t from_x = (ray.x - first_x_ * kFloorCell) << kSlopeBits;
  const std::int32_t from_y = (ray.y - first_y_ * kFloorCell) << kSlopeBits;
  const auto outside = [&](std::int32_t range) {
    const std::int32_t column = (from_x + range * ray.axis_x) >> kCellBits;
    const std::int32_t row = (from_y + range * ray.axis_y) >> kCellBits;
    return ((column | row) & ~(kCells - 1)) != 0;
  };
  // Between two places of the grid all are.
  std::int32_t last = kFloorReach;
  while (last >= first && outside(last)) last -= step;
  if (last < first || outside(first)) return 0;
  // Rows and bits go round: of the first cell only what is left over counts.
  std::int32_t x = from_x + ((first_x_ & (kCells - 1)) << kCellBits) + first * ray.axis_x;
  std::int32_t y = from_y + ((first_y_ & (kCells - 1)) << kCellBits) + first * ray.axis_y;
  std::int32_t range = first;
  for (; range <= last; range += step) {
    const std::size_t row = row_of(y >> kCellBits);
    const auto column = static_cast<std::uint32_t>(x >> kCellBits);
    // Half of them: shifts of 64 bits are calls, or many instructions, on small cores.
    const std::uint64_t cells = now_[row] | before_[row];
    const auto half = static_cast<std::uint32_t>((column & 32U) != 0 ? cells >> 32U : cells);
    if (((half >> (column & 31U)) & 1U) == 0) break;
    x += step * ray.axis_x;
    y += step * ray.axis_y;
  }
  return range == first ? 0 : range - step;
}

bool SeenFloor::seen(std::int32_t x, std::int32_t y) const {
  const std::int32_t column = x >> kFloorCellLog2;
  const std::int32_t row = y >> kFloorCellLog2;
  return has_looked_ && holds(column, row) && ((now_[row_of(row)] | before_[row_of(row)]) & bit_of(column)) != 0;
}

}  // namespace fencepost::recon::guard
