#include "host/evaluate/assignment.hpp"

namespace fencepost::host {
namespace {

/// Each row also has a dummy column of its own for staying unassigned, so every row is always assigned.
class Hungarian {
 public:
  Hungarian(const std::vector<std::vector<double>>& costs, double alone)
      : costs_(costs),
        alone_(alone),
        rows_(costs.size()),
        real_(costs.empty() ? 0 : costs.front().size()),
        columns_(real_ + rows_),
        row_price_(rows_),
        column_price_(columns_ + 1),
        row_of_(columns_ + 1, kNobody) {}

  std::vector<std::optional<std::size_t>> solve() {
    for (std::size_t row = 0; row < rows_; ++row) place(row);
    std::vector<std::optional<std::size_t>> pairs(rows_);
    for (std::size_t column = 0; column < real_; ++column) {
      if (row_of_[column] != kNobody) pairs[row_of_[column]] = column;
    }
    return pairs;
  }

 private:
  static constexpr std::size_t kNobody = static_cast<std::size_t>(-1);

  [[nodiscard]] double cost(std::size_t row, std::size_t column) const {
    if (column < real_) return costs_[row][column];
    if (column - real_ == row) return alone_;
    return kNeverPaired;
  }

  // Grows a tree of cheapest alternating paths from `row` until a free column is reached, then flips the path.
  void place(std::size_t row) {
    const std::size_t start = columns_;  // a column that does not exist holds the new row
    std::vector<double> slack(columns_, kNeverPaired);
    std::vector<std::size_t> from(columns_, start);
    std::vector<bool> in_tree(columns_ + 1);
    row_of_[start] = row;
    std::size_t column = start;
    while (row_of_[column] != kNobody) {
      in_tree[column] = true;
      const std::size_t next = nearest(row_of_[column], column, slack, from, in_tree);
      const double step = slack[next];
      for (std::size_t c = 0; c <= columns_; ++c) {
        if (in_tree[c]) {
          row_price_[row_of_[c]] += step;
          column_price_[c] -= step;
        } else {
          slack[c] -= step;
        }
      }
      column = next;
    }
    for (; column != start; column = from[column]) row_of_[column] = row_of_[from[column]];
    row_of_[start] = kNobody;
  }

  std::size_t nearest(std::size_t row, std::size_t reached_by, std::vector<double>& slack,
                      std::vector<std::size_t>& from, const std::vector<bool>& in_tree) const {
    std::size_t best = columns_;
    for (std::size_t c = 0; c < columns_; ++c) {
      if (in_tree[c]) continue;
      const double reduced = cost(row, c) - row_price_[row] - column_price_[c];
      if (reduced < slack[c]) {
        slack[c] = reduced;
        from[c] = reached_by;
      }
      if (best == columns_ || slack[c] < slack[best]) best = c;
    }
    return best;
  }

  const std::vector<std::vector<double>>& costs_;
  double alone_;
  std::size_t rows_;
  std::size_t real_;  ///< columns of `costs_`
  std::size_t columns_;
  std::vector<double> row_price_;
  std::vector<double> column_price_;
  std::vector<std::size_t> row_of_;
};

}  // namespace

std::vector<std::optional<std::size_t>> pair_cheapest(const std::vector<std::vector<double>>& costs, double alone) {
  return Hungarian(costs, alone).solve();
}

}  // namespace fencepost::host
