#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "host/doctor/log/difference.hpp"
#include "host/text/printable.hpp"

namespace fencepost::host::doctor {
namespace {

std::string values_text(const char* title, const std::vector<ValueDifference>& values) {
  std::string text = fmt::format("{}: {}\n", title, values.empty() ? "the same" : "");
  for (const ValueDifference& value : values) {
    const auto shown = [](const std::string& word) { return word.empty() ? std::string("-") : printable(word); };
    text += fmt::format("  {:<20} {:>16} {:>16}\n", printable(value.key), shown(value.first), shown(value.second));
  }
  return text;
}

std::string alert_text(const std::optional<record::AlertReport>& alert) {
  if (!alert) return "-";
  const std::string place = alert->has_place() ? fmt::format("  {:.2f} m", alert->distance.to_double()) : "";
  return fmt::format("{:.2f} s{}", alert->t.to_double(), place);
}

std::string alert_line(const AlertDifference& alert) {
  const record::AlertReport& one = alert.first ? *alert.first : *alert.second;
  return fmt::format("  {:<20} {:>16} {:>16}\n", fmt::format("{} signature {}", record::name(one.level), one.signature),
                     alert_text(alert.first), alert_text(alert.second));
}

nlohmann::ordered_json values_json(const std::vector<ValueDifference>& values) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const ValueDifference& value : values) {
    list.push_back(
        {{"key", printable(value.key)}, {"first", printable(value.first)}, {"second", printable(value.second)}});
  }
  return list;
}

nlohmann::ordered_json alert_json(const std::optional<record::AlertReport>& alert) {
  if (!alert) return nullptr;
  nlohmann::ordered_json json = {{"t", alert->t.to_double()}, {"id", alert->id}};
  if (alert->has_place()) json["distance"] = alert->distance.to_double();
  return json;
}

}  // namespace

std::string difference_text(const Difference& difference, const std::string& first, const std::string& second) {
  std::string text = fmt::format("first: {}\nsecond: {}\n\n", printable(first), printable(second)) +
                     values_text("settings", difference.settings) + values_text("calibration", difference.calibration);
  text += fmt::format("alerts: {} alike{}\n", difference.alerts_alike,
                      difference.alerts.empty() ? "" : fmt::format(", {} differ", difference.alerts.size()));
  for (const AlertDifference& alert : difference.alerts) text += alert_line(alert);
  return text;
}

nlohmann::ordered_json difference_json(const Difference& difference) {
  nlohmann::ordered_json alerts = nlohmann::ordered_json::array();
  for (const AlertDifference& alert : difference.alerts) {
    const record::AlertReport& one = alert.first ? *alert.first : *alert.second;
    alerts.push_back({{"level", record::name(one.level)},
                      {"signature", one.signature},
                      {"first", alert_json(alert.first)},
                      {"second", alert_json(alert.second)}});
  }
  return {{"format", 1},
          {"settings", values_json(difference.settings)},
          {"calibration", values_json(difference.calibration)},
          {"alerts_alike", difference.alerts_alike},
          {"alerts", std::move(alerts)}};
}

}  // namespace fencepost::host::doctor
