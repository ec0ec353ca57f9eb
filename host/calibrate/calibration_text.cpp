#include "host/calibrate/calibration_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "host/calibrate/known.hpp"
#include "host/live/record_line.hpp"
#include "host/result/geojson.hpp"
#include "host/text/plural.hpp"
#include "host/text/printable.hpp"

namespace fencepost::host {
namespace {

constexpr double kDegrees = 57.29577951308232;

std::string number(double value, int decimals) { return fmt::format("{:.{}f}", value, decimals); }

std::string row_of(const Finding& finding) {
  const std::string found = finding.held ? "not found" : number(finding.found, finding.decimals);
  const std::string sigma = finding.held ? "" : number(finding.sigma, finding.decimals);
  return fmt::format("{:<18}{:>10}{:>11}{:>10}  {}\n", finding.label, number(finding.configured, finding.decimals),
                     found, sigma, finding.unit);
}

std::string row_of(const FoundPad& pad, const std::vector<record::Signature>& signatures) {
  constexpr int kDecimals = 1;
  const std::string label = "pad of " + printable(signature_name(signatures, pad.signature));
  return fmt::format("{:<18}{:>10}{:>11}{:>10}  px\n", label, number(pad.configured, kDecimals),
                     number(pad.found, kDecimals), number(pad.sigma, kDecimals));
}

/// The signatures whose pads were found.
std::vector<record::Signature> padded(const Calibration& calibration) {
  std::vector<record::Signature> all;
  for (const record::Signature& signature : calibration.signatures) {
    const auto of_it = [&](const FoundPad& pad) { return pad.signature == signature.signature; };
    if (std::ranges::any_of(calibration.pads, of_it)) all.push_back(signature);
  }
  return all;
}

/// The drives that the log lacks, and for which numbers.
std::string missing(const Calibration& calibration, bool held, const char* heading) {
  std::vector<std::pair<std::string_view, std::string>> wanted;
  for (const Finding& finding : calibration.findings) {
    if (finding.observed || finding.held != held) continue;
    const auto same = [&](const auto& entry) { return entry.first == finding.motion; };
    const auto known = std::ranges::find_if(wanted, same);
    if (known == wanted.end()) {
      wanted.emplace_back(finding.motion, finding.label);
    } else {
      known->second += fmt::format(", {}", finding.label);
    }
  }
  if (wanted.empty()) return "";
  std::string text = fmt::format("\n{}:\n", heading);
  for (const auto& [motion, labels] : wanted) text += fmt::format("  {}: {}\n", labels, motion);
  return text;
}

std::string residual_rows(const Calibration& calibration) {
  const auto row = [](const char* label, double before, double after, const char* unit) {
    return fmt::format("{:<18}{:>10.2f}{:>11.2f}{:>10}  {}\n", label, before, after, "", unit);
  };
  std::string text = fmt::format("\n{:<18}{:>10}{:>11}\n", "residual (68 %)", "before", "after");
  text += row("edges", calibration.before.columns_px, calibration.after.columns_px, "px");
  text += row("", calibration.before.columns_cm, calibration.after.columns_cm, "cm");
  if (calibration.after.rows_px > 0) {
    text += row("feet and tops", calibration.before.rows_px, calibration.after.rows_px, "px");
  }
  return text;
}

nlohmann::ordered_json residuals_json(const Residuals& residuals) {
  return {{"edges_px", rounded(residuals.columns_px, 4)},
          {"edges_m", rounded(residuals.columns_cm / 100, 6)},
          {"rows_px", rounded(residuals.rows_px, 4)}};
}

}  // namespace

std::string calibration_text(const Calibration& calibration, const std::string& log_name) {
  std::string text = fmt::format("{}: {}, {}, {:.0f} s, {:.1f} m, {:.0f} degrees turned\n\n", printable(log_name),
                                 plural(calibration.frames, "frame"), plural(calibration.objects.size(), "object"),
                                 calibration.seconds, calibration.driven, calibration.turned * kDegrees);
  text += fmt::format("{:<18}{:>10}{:>11}{:>10}\n", "", "configured", "found", "+-");
  for (const Finding& finding : calibration.findings) text += row_of(finding);
  for (const FoundPad& pad : calibration.pads) text += row_of(pad, calibration.signatures);
  text += residual_rows(calibration);
  text += missing(calibration, true, "Not found from this log, and left as configured");
  text += missing(calibration, false, "Hardly known from this log, and mostly as configured");
  text += "\n" + record_line(calibration.found);
  for (const record::Signature& signature : padded(calibration)) text += record_line(signature);
  return text;
}

std::string calibration_json(const Calibration& calibration) {
  constexpr int kDecimals = 6;
  nlohmann::ordered_json parameters = nlohmann::ordered_json::object();
  for (const Finding& finding : calibration.findings) {
    nlohmann::ordered_json entry = {{"unit", finding.unit},
                                    {"observed", finding.observed},
                                    {"configured", rounded(finding.configured, kDecimals)},
                                    {"found", nullptr},
                                    {"sigma", nullptr},
                                    {"motion", nullptr}};
    if (!finding.held) {
      entry["found"] = rounded(finding.found, kDecimals);
      entry["sigma"] = rounded(finding.sigma, kDecimals);
    }
    if (!finding.observed) entry["motion"] = finding.motion;
    parameters[std::string(finding.key)] = std::move(entry);
  }
  nlohmann::ordered_json pads = nlohmann::ordered_json::array();
  for (const FoundPad& pad : calibration.pads) {
    pads.push_back({{"signature", pad.signature},
                    {"configured", rounded(pad.configured, kDecimals)},
                    {"found", rounded(pad.found, kDecimals)},
                    {"sigma", rounded(pad.sigma, kDecimals)}});
  }
  nlohmann::ordered_json signatures = nlohmann::ordered_json::array();
  for (const record::Signature& signature : padded(calibration)) {
    signatures.push_back(record_line_without_end(signature));
  }
  const nlohmann::ordered_json root = {
      {"format", 1},
      {"complete", calibration.complete()},
      {"frames", calibration.frames},
      {"objects", calibration.objects.size()},
      {"seconds", rounded(calibration.seconds, 4)},
      {"driven", rounded(calibration.driven, kDecimals)},
      {"turned", rounded(calibration.turned, kDecimals)},
      {"parameters", std::move(parameters)},
      {"residuals", {{"before", residuals_json(calibration.before)}, {"after", residuals_json(calibration.after)}}},
      {"pads", std::move(pads)},
      {"fpcam", record_line_without_end(calibration.found)},
      {"fpsig", std::move(signatures)}};
  return root.dump() + "\n";
}

}  // namespace fencepost::host
