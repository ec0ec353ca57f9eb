#include "firmware/recon/track/assignment.hpp"

#include "firmware/recon/track/tuning.hpp"
#include "hal/base/check.hpp"

namespace fencepost::recon {
namespace {

// A pair that cannot be is dearer than leaving every blob unmatched.
constexpr std::int16_t kForbidden = 4000;
static_assert(kForbidden > static_cast<int>(sensor::kMaxBlobs) * kUnmatchedCost);

// Kuhn's method with potentials, one blob (row) at a time along the cheapest augmenting path. Rows and columns count
// from 1; column 0 stands for "the row being placed".
class Hungarian {
 public:
  Hungarian(std::span<const std::uint8_t> costs, std::size_t objects, std::size_t blobs,
            std::span<AssignmentColumn> columns)
      : costs_(costs), objects_(objects), blobs_(blobs), columns_(columns) {}

  void place(std::size_t row) {
    if (place_free(row)) return;
    columns_[0].row = static_cast<std::uint8_t>(row);
    std::size_t column = 0;
    for (AssignmentColumn& any : columns_) {
      any.slack = std::numeric_limits<std::int16_t>::max();
      any.visited = false;
    }
    do {
      column = grow(column);
    } while (columns_[column].row != 0);
    while (column != 0) {  // turn the path's pairs over
      const std::size_t before = columns_[column].came_from;
      columns_[column].row = columns_[before].row;
      column = before;
    }
  }

 private:
  // The cheapest column, if no other row has it: the path then ends where it begins, and most do.
  bool place_free(std::size_t row) {
    int least = std::numeric_limits<std::int16_t>::max();
    std::size_t best = 0;
    for (std::size_t j = 1; j < columns_.size(); ++j) {
      const int reduced = cost(row, j) - columns_[j].potential;
      if (reduced >= least) continue;
      least = reduced;
      best = j;
    }
    if (columns_[best].row != 0) return false;
    columns_[best].row = static_cast<std::uint8_t>(row);
    row_potential_[row] = static_cast<std::int16_t>(least);
    return true;
  }

  [[nodiscard]] int cost(std::size_t row, std::size_t column) const {
    if (column > objects_) return column - objects_ == row ? kUnmatchedCost : kForbidden;
    const std::uint8_t value = costs_[(column - 1) * blobs_ + row - 1];
    return value == kImpossible ? kForbidden : value;
  }

  // Visits `column`, updates the slacks from its row, and answers the cheapest column to go on with.
  std::size_t grow(std::size_t column) {
    columns_[column].visited = true;
    const std::size_t row = columns_[column].row;
    int delta = std::numeric_limits<std::int16_t>::max();
    std::size_t next = 0;
    for (std::size_t j = 1; j < columns_.size(); ++j) {
      AssignmentColumn& other = columns_[j];
      if (other.visited) continue;
      const int reduced = cost(row, j) - row_potential_[row] - other.potential;
      if (reduced < other.slack) {
        other.slack = static_cast<std::int16_t>(reduced);
        other.came_from = static_cast<std::uint8_t>(column);
      }
      if (other.slack < delta) {
        delta = other.slack;
        next = j;
      }
    }
    for (AssignmentColumn& any : columns_) {
      if (any.visited) {
        row_potential_[any.row] = static_cast<std::int16_t>(row_potential_[any.row] + delta);
        any.potential = static_cast<std::int16_t>(any.potential - delta);
      } else {
        any.slack = static_cast<std::int16_t>(any.slack - delta);
      }
    }
    return next;
  }

  std::span<const std::uint8_t> costs_;
  std::size_t objects_;
  std::size_t blobs_;
  std::span<AssignmentColumn> columns_;
  std::array<std::int16_t, sensor::kMaxBlobs + 1> row_potential_{};
};

}  // namespace

void assign(std::span<const std::uint8_t> costs, std::size_t objects, std::span<std::uint8_t> object_of,
            std::span<AssignmentColumn> scratch) {
  const std::size_t blobs = object_of.size();
  FENCEPOST_CHECK(blobs <= sensor::kMaxBlobs && scratch.size() > objects + blobs && costs.size() >= objects * blobs);
  const std::span<AssignmentColumn> columns = scratch.first(objects + blobs + 1);
  for (AssignmentColumn& column : columns) column = {};
  Hungarian hungarian(costs, objects, blobs, columns);
  for (std::size_t row = 1; row <= blobs; ++row) hungarian.place(row);
  for (std::uint8_t& object : object_of) object = kNoMatch;
  for (std::size_t column = 1; column <= objects; ++column) {
    const std::size_t row = columns[column].row;
    if (row != 0) object_of[row - 1] = static_cast<std::uint8_t>(column - 1);
  }
}

}  // namespace fencepost::recon
