// Measurements, as tests/results/performance.md shows it.
#pragma once

#include <string>
#include <vector>

#include "tests/bench/contender.hpp"

namespace fencepost::bench {

struct Measured {
  Contender contender;
  double ns = 0;  ///< an object and view, median of the repetitions
};

/// Both tables in Markdown; ratios are to the clip, and to the limit of the same grid.
std::string tables(const std::vector<Measured>& all);

/// Processor, compiler and day.
std::string machine();

/// Replaces the text between the marks in the file. False: it cannot be read or written, or has no marks.
bool write_between_marks(const std::string& path, const std::string& text);

}  // namespace fencepost::bench
