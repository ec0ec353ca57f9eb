// A survey of a log, for people and for programs.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <string>

#include "host/doctor/finding.hpp"
#include "host/doctor/log/survey.hpp"

namespace fencepost::host::doctor {

/// "red", or "signature 3".
std::string colour_name(const LogSurvey& survey, std::uint8_t signature);

/// Rates, lines, a table of colours; without the findings.
std::string survey_text(const LogSurvey& survey);

/// The same; the layout is in share/doc/doctor.md.
nlohmann::ordered_json survey_json(const LogSurvey& survey);

}  // namespace fencepost::host::doctor
