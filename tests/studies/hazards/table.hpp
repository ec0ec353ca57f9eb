// The table: a row a cell and listener.
#pragma once

#include <string>

#include "tests/studies/common/study.hpp"
#include "tests/studies/hazards/cell.hpp"

namespace fencepost::test {

inline constexpr unsigned kLastTuningSeed = 1000;       ///< seeds up to it may be tuned on
inline constexpr unsigned kFirstJudgingSeed = 100'001;  ///< seeds from it on judge

/// "tuning", "judging", or "neither tuning nor judging".
std::string_view use_of(const Seeds& seeds);

/// Promise, measure and the table's head.
std::string head(const Family& family);
/// `seconds`: of the processor, that the row took.
std::string row(const Cell& cell, Rule rule, unsigned runs, const Outcome& sum, double seconds);

/// The judge's verdict: the figures that miss the cell's target, empty if all are reached. A cell that was asked
/// nothing misses any target.
std::string missed(const Target& target, const Outcome& sum);

double percent_kept(const Outcome& outcome);
double in_ten_minutes(const Outcome& outcome, unsigned count);
/// The lower middle one; nothing without any.
std::optional<double> median(std::vector<double> values);

}  // namespace fencepost::test
