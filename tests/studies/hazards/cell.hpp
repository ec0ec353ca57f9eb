// A cell of the table: one kind of encounter, run with many seeds.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tests/studies/common/noise_levels.hpp"
#include "tests/studies/hazards/listener.hpp"
#include "tests/studies/hazards/outcome.hpp"

namespace fencepost::test {

/// The conditions of a cell's runs.
struct Conditions {
  NoiseLevel level;
  Rule rule = Rule::kFencepost;
  std::string profile = "full";
  std::vector<record::Setting> settings{};  ///< given to the robot, not to the judge: to plant a fault
  std::optional<double> rate{};             ///< frames/s, in place of the family's
};

/// The targets of a judged cell.
struct Target {
  std::optional<double> kept{};         ///< %, at least
  std::optional<double> false_stops{};  ///< in 10 minutes, grazes left out, at most
};

struct Cell {
  std::string scene;
  Target target;
  std::function<Outcome(unsigned seed, const Conditions& conditions)> run;
  std::string level{};  ///< key of the noise level; empty: the table's
};

struct Family {
  std::string name;
  std::string promise;  ///< the meaning of "kept"
  std::string measure;  ///< the measure, with its unit
  std::vector<Cell> cells;
};

Family walls();
Family corridors();
Family passing();
Family approaches();
Family movers();
Family obeying();
Family removal();
Family bases();
Family cameras();
Family turning();
Family blind();

/// All, in the table's order.
std::vector<Family> families();

}  // namespace fencepost::test
