// The figures of the cells that miss their target, so that one that grows worse is noticed all the same.
#pragma once

#include <string>
#include <vector>

#include "tests/studies/hazards/cell.hpp"

namespace fencepost::test {

/// The counts of one cell's runs.
struct Reached {
  std::string family;
  std::string scene;
  unsigned asked = 0;
  unsigned kept = 0;
  double seconds = 0;
  unsigned false_stops = 0;  ///< grazes left out
};

Reached reached(const Family& family, const Cell& cell, const Outcome& sum);

/// Reads a file of lines by `as_line`, with a head; throws with the file's name and the line that it cannot read.
std::vector<Reached> read_reached(const std::string& path);
std::string reached_head();
std::string as_line(const Reached& reached);

/// The cell of the same name; nullptr: there is none.
const Reached* find(const std::vector<Reached>& all, const Reached& like);

/// The figures worse than `before` by more than three standard errors of both; empty if none is.
std::string worse(const Reached& before, const Reached& now);

}  // namespace fencepost::test
