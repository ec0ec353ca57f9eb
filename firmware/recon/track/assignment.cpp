#include "firmware/recon/track/assignment.hpp"

#include <array>

#include "hal/base/check.hpp"

namespace fencepost::recon {
namespace {

constexpr std::size_t kMaxBlobs = 16;
constexpr std::size_t kMaxObjects = 32;
constexpr std::size_t kMaxColumns = kMaxObjects + kMaxBlobs;  // each blob may also stay alone: a column of its own

// A pair that cannot be is dearer than leaving every blob alone.
constexpr std::int16_t kForbidden = 4000;

// Kuhn's method with potentials, one blob (row) at a time along the cheapest augmenting path. Rows and columns count
// from 1; column 0 stands for "the row being placed".
class Hungarian {
 public:
  Hungarian(std::span<const std::uint8_t> costs, std::size_t objects, std::size_t blobs)
      : costs_(costs), objects_(objects), blobs_(blobs), columns_(objects + blobs) {}

  void place(std::size_t row) {
    row_of_[0] = static_cast<std::uint8_t>(row);
    std::size_t column = 0;
    for (std::size_t j = 0; j <= columns_; ++j) {
      slack_[j] = std::numeric_limits<std::int16_t>::max();
      visited_[j] = false;
    }
    do {
      column = grow(column);
    } while (row_of_[column] != 0);
    while (column != 0) {  // turn the path's pairs over
      const std::size_t before = came_from_[column];
      row_of_[column] = row_of_[before];
      column = before;
    }
  }

  [[nodiscard]] std::size_t row_of(std::size_t column) const { return row_of_[column]; }

 private:
  [[nodiscard]] int cost(std::size_t row, std::size_t column) const {
    if (column > objects_) return column - objects_ == row ? kUnmatchedCost : kForbidden;
    const std::uint8_t value = costs_[(column - 1) * blobs_ + row - 1];
    return value == kImpossible ? kForbidden : value;
  }

  // Visits `column`, updates the slacks from its row, and answers the cheapest column to go on with.
  std::size_t grow(std::size_t column) {
    visited_[column] = true;
    const std::size_t row = row_of_[column];
    int delta = std::numeric_limits<std::int16_t>::max();
    std::size_t next = 0;
    for (std::size_t j = 1; j <= columns_; ++j) {
      if (visited_[j]) continue;
      const int reduced = cost(row, j) - row_potential_[row] - column_potential_[j];
      if (reduced < slack_[j]) {
        slack_[j] = static_cast<std::int16_t>(reduced);
        came_from_[j] = static_cast<std::uint8_t>(column);
      }
      if (slack_[j] < delta) {
        delta = slack_[j];
        next = j;
      }
    }
    for (std::size_t j = 0; j <= columns_; ++j) {
      if (visited_[j]) {
        row_potential_[row_of_[j]] = static_cast<std::int16_t>(row_potential_[row_of_[j]] + delta);
        column_potential_[j] = static_cast<std::int16_t>(column_potential_[j] - delta);
      } else {
        slack_[j] = static_cast<std::int16_t>(slack_[j] - delta);
      }
    }
    return next;
  }

  std::span<const std::uint8_t> costs_;
  std::size_t objects_;
  std::size_t blobs_;
  std::size_t columns_;
  std::array<std::int16_t, kMaxBlobs + 1> row_potential_{};
  std::array<std::int16_t, kMaxColumns + 1> column_potential_{};
  std::array<std::int16_t, kMaxColumns + 1> slack_{};
  std::array<std::uint8_t, kMaxColumns + 1> row_of_{};  ///< row matched to a column, 0: free
  std::array<std::uint8_t, kMaxColumns + 1> came_from_{};
  std::array<bool, kMaxColumns + 1> visited_{};
};

}  // namespace

void assign(std::span<const std::uint8_t> costs, std::size_t objects, std::span<std::uint8_t> object_of) {
  const std::size_t blobs = object_of.size();
  FENCEPOST_CHECK(objects <= kMaxObjects && blobs <= kMaxBlobs && costs.size() >= objects * blobs);
  Hungarian hungarian(costs, objects, blobs);
  for (std::size_t row = 1; row <= blobs; ++row) hungarian.place(row);
  for (std::uint8_t& object : object_of) object = kNoMatch;
  for (std::size_t column = 1; column <= objects; ++column) {
    const std::size_t row = hungarian.row_of(column);
    if (row != 0) object_of[row - 1] = static_cast<std::uint8_t>(column - 1);
  }
}

}  // namespace fencepost::recon
