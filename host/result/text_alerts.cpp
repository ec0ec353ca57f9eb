#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "firmware/console/text.hpp"
#include "host/result/lookup.hpp"
#include "host/result/text.hpp"
#include "host/text/plural.hpp"
#include "host/text/printable.hpp"

namespace fencepost::host {
namespace {

const char* level_colour(record::AlertLevel level) {
  constexpr std::array<const char*, 5> kColours = {"\x1b[2m", "\x1b[36m", "\x1b[33m", "\x1b[1;31m", "\x1b[1;35m"};
  return kColours[static_cast<std::size_t>(level)];
}

/// The robot's own words for it, so that the desk and the console never differ.
std::string robot_sentence(const ResultDocument& document, const record::AlertReport& alert) {
  const record::Signature* signature = find_signature(document, alert.signature);
  const std::string name = signature != nullptr ? printable(signature->name.view()) : "";
  std::array<char, console::kMaxSentence> buffer{};
  std::string sentence(buffer.data(), console::describe(alert, name, buffer));
  while (!sentence.empty() && (sentence.back() == '\n' || sentence.back() == '\r')) sentence.pop_back();
  return sentence;
}

}  // namespace

std::string alert_sentence(const ResultDocument& document, const record::AlertReport& alert,
                           const TextOptions& options) {
  std::string sentence = robot_sentence(document, alert);
  if (options.colour) {
    const std::size_t word = std::min(sentence.find(' '), sentence.size());
    sentence = level_colour(alert.level) + sentence.substr(0, word) + "\x1b[0m" + sentence.substr(word);
  }
  const std::string of = alert.id == record::kNoObject ? "guard" : fmt::format("object {}", alert.id);
  return fmt::format("{:>9.3f} s  {}  ({})", alert.t.to_double(), sentence, of);
}

std::string alert_list(const ResultDocument& document, const TextOptions& options) {
  std::string list;
  std::map<std::uint32_t, record::AlertLevel> said;
  for (const record::AlertReport& alert : document.alerts) {
    const auto last = said.find(alert.id);
    const bool repeat = last != said.end() && last->second == alert.level;
    said[alert.id] = alert.level;
    if (!(repeat && options.changes_only)) list += alert_sentence(document, alert, options) + "\n";
  }
  return list;
}

std::string calibration_sentence(const record::CalibrationDoubt& doubt) {
  std::array<char, console::kMaxSentence> buffer{};
  const std::size_t size = console::describe_calibration(doubt, buffer);
  return {buffer.data(), size < 2 ? 0 : size - 2};
}

std::string calibration_list(const ResultDocument& document) {
  std::string list;
  for (const record::CalibrationDoubt& doubt : document.calibration) {
    list += fmt::format("{:>9.3f} s  {}\n", doubt.t.to_double(), calibration_sentence(doubt));
  }
  return list;
}

std::string summary_line(const ResultDocument& document) { return summary_line(document, document.alerts.size()); }

std::string counts(const ResultDocument& document, std::uint64_t alerts) {
  const auto confirmed = std::count_if(document.objects.begin(), document.objects.end(), [](const ObjectResult& o) {
    return o.state != record::ObjectState::kTentative;  // lost ones are confirmed, only out of sight
  });
  return fmt::format("{} ({} confirmed), {}, {}", plural(document.objects.size(), "object"), confirmed,
                     plural(alerts, "alert"), plural(document.log.frames, "frame"));
}

std::string summary_line(const ResultDocument& document, std::uint64_t alerts) {
  return fmt::format("{}, profile {}, digest {}\n", counts(document, alerts), printable(document.profile),
                     digest_text(document.digest));
}

}  // namespace fencepost::host
