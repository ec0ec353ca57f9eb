// What the doctor found, for people and for programs.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace fencepost::host::doctor {

enum class Severity : std::uint8_t {
  kNote,     ///< worth knowing
  kWarning,  ///< the map or the alerts are worse for it
  kFault,    ///< something does not work
};

constexpr std::string_view name(Severity severity) {
  switch (severity) {
    case Severity::kNote: return "note";
    case Severity::kWarning: return "warning";
    case Severity::kFault: return "fault";
  }
  return "note";
}

struct Finding {
  Severity severity = Severity::kNote;
  std::string code;    ///< stable, such as "crc"
  std::string what;    ///< a clause, with its figures
  std::string remedy;  ///< what to try; may be empty
};
using Findings = std::vector<Finding>;

bool has_fault(const Findings& findings);

/// "FAULT    what; remedy" a line, the worst first; of none nothing.
std::string findings_text(const Findings& findings);

/// [{"severity", "code", "what", "remedy"}], the worst first.
nlohmann::ordered_json findings_json(const Findings& findings);

}  // namespace fencepost::host::doctor
