// Two logs of one robot: what is worse today than on a good day.
#pragma once

#include <string>
#include <vector>

#include "host/doctor/finding.hpp"
#include "host/doctor/log/survey.hpp"

namespace fencepost::host::doctor {

struct Worse {
  std::string what;  ///< such as "frames a second", "red: flicker /100"
  double today = 0;
  double good = 0;
};

/// Only what is worse by more than two drives of one healthy robot differ.
std::vector<Worse> what_is_worse(const LogSurvey& today, const LogSurvey& good);

/// A table, or a sentence where nothing is.
std::string worse_text(const std::vector<Worse>& worse, const std::string& good_name);
nlohmann::ordered_json worse_json(const std::vector<Worse>& worse);

}  // namespace fencepost::host::doctor
