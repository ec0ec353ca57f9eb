#include "host/doctor/finding.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "host/text/printable.hpp"

namespace fencepost::host::doctor {
namespace {

Findings worst_first(Findings findings) {
  std::ranges::stable_sort(findings, [](const Finding& a, const Finding& b) { return a.severity > b.severity; });
  return findings;
}

std::string_view word(Severity severity) {
  switch (severity) {
    case Severity::kNote: return "note";
    case Severity::kWarning: return "WARNING";
    case Severity::kFault: return "FAULT";
  }
  return "";
}

}  // namespace

Code Code::of(std::string_view word) {
  Code code;
  code.word_ = listed(word);
  return code;
}

bool has_fault(const Findings& findings) {
  return std::ranges::any_of(findings, [](const Finding& finding) { return finding.severity == Severity::kFault; });
}

std::string findings_text(const Findings& findings) {
  std::string text;
  for (const Finding& finding : worst_first(findings)) {
    text += fmt::format("{:<8} {}{}{}\n", word(finding.severity), printable(finding.what),
                        finding.remedy.empty() ? "" : "; ", printable(finding.remedy));
  }
  return text;
}

nlohmann::ordered_json findings_json(const Findings& findings) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Finding& finding : worst_first(findings)) {
    list.push_back({{"severity", name(finding.severity)},
                    {"code", finding.code.str()},
                    {"what", printable(finding.what)},
                    {"remedy", printable(finding.remedy)}});
  }
  return list;
}

}  // namespace fencepost::host::doctor
