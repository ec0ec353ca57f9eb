#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "host/result/lookup.hpp"
#include "host/result/printable.hpp"
#include "host/result/text.hpp"

namespace fencepost::host {
namespace {

constexpr double kDegreesPerRadian = 180 / std::numbers::pi;

std::string level_word(record::AlertLevel level, bool colour) {
  constexpr std::array<const char*, 4> kWords = {"clear ", "notice", "WARN  ", "STOP  "};
  constexpr std::array<const char*, 4> kColours = {"\x1b[2m", "\x1b[36m", "\x1b[33m", "\x1b[1;31m"};
  const auto index = static_cast<std::size_t>(level);
  return colour ? fmt::format("{}{}\x1b[0m", kColours[index], kWords[index]) : kWords[index];
}

std::string bearing_words(double bearing) {
  const double degrees = std::round(bearing * kDegreesPerRadian);
  if (degrees == 0) return "ahead";
  return fmt::format("{:.0f} deg {}", std::abs(degrees), degrees > 0 ? "left" : "right");
}

}  // namespace

std::string alert_sentence(const ResultDocument& document, const record::AlertReport& alert,
                           const TextOptions& options) {
  const std::string contact = alert.ttc ? fmt::format(", contact in {:.1f} s", alert.ttc->to_double()) : "";
  return fmt::format("{:>9.3f} s  {}  {}  {:.2f} m  {}{}  (object {})", alert.t.to_double(),
                     level_word(alert.level, options.colour), printable(signature_name(document, alert.signature)),
                     alert.distance.to_double(), bearing_words(alert.bearing.to_double()), contact, alert.id);
}

std::string alert_list(const ResultDocument& document, const TextOptions& options) {
  std::string list;
  for (const record::AlertReport& alert : document.alerts) list += alert_sentence(document, alert, options) + "\n";
  return list;
}

std::string summary_line(const ResultDocument& document) {
  const auto confirmed = std::count_if(document.objects.begin(), document.objects.end(), [](const ObjectResult& o) {
    return o.state == record::ObjectState::kConfirmed;
  });
  const auto plural = [](std::size_t n) { return n == 1 ? "" : "s"; };
  return fmt::format("{} object{} ({} confirmed), {} alert{}, {} frame{}, profile {}, digest {}\n",
                     document.objects.size(), plural(document.objects.size()), confirmed, document.alerts.size(),
                     plural(document.alerts.size()), document.log.frames, plural(document.log.frames),
                     printable(document.profile), digest_text(document.digest));
}

}  // namespace fencepost::host
