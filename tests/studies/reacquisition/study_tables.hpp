// The tables of the reacquisition study and their targets.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "host/paper/reacquire.hpp"

namespace fencepost::test {

struct StudyWorld {
  host::BlocksWorld kind;
  std::string_view key;  ///< on the command line
  std::string_view name;
  double least_right;      ///< share of decisions that the hybrid has to get right
  double least_area;       ///< under the curve of its margin; 0: nothing is asked
  bool against_the_paper;  ///< and each of the paper's algorithms has to be above the paper's own share
};

/// The paper-like one, then harder ones.
const std::vector<StudyWorld>& study_worlds();

/// One for each of host::algorithms().
using StudyScores = std::vector<host::ReacquisitionScore>;

/// `recoloured`: a planted fault, all models are rendered in grey.
StudyScores run_world(const StudyWorld& world, unsigned scenes, unsigned first_seed, bool recoloured);

/// Markdown: rows of the paper's Figure 10, then errors and confidences.
std::string study_table(const StudyWorld& world, unsigned scenes, const StudyScores& scores);

struct Verdict {
  std::string text;
  bool reached = true;
};
/// The targets of this world's scores, each with a figure.
std::vector<Verdict> verdicts(const StudyWorld& world, const StudyScores& scores);

}  // namespace fencepost::test
