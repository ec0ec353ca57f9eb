#include "host/live/alert_now.hpp"

#include <algorithm>
#include <array>

#include "firmware/record/decode.hpp"

namespace fencepost::host {
namespace {

constexpr std::array<std::string_view, 3> kWanted = {"$FPALR,", "$FPSIG,", "$FPHDR,"};

bool wanted(std::string_view line) {
  return std::any_of(kWanted.begin(), kWanted.end(), [&](std::string_view kind) { return line.starts_with(kind); });
}

}  // namespace

void AlertFollower::take(std::string_view lines) {
  while (!lines.empty()) {
    const std::size_t end = std::min(lines.find('\n'), lines.size() - 1) + 1;
    std::string_view line = lines.substr(0, end);
    lines.remove_prefix(end);
    if (!wanted(line)) continue;
    while (line.ends_with('\n') || line.ends_with('\r')) line.remove_suffix(1);
    static_cast<void>(record::decode(line, {}, *this));
  }
}

void AlertFollower::accept(const record::Header& /*begins a run*/) { in_force_.clear(); }

void AlertFollower::accept(const record::Signature& signature) {
  names_[signature.signature] = std::string(signature.name.view());
}

void AlertFollower::accept(const record::AlertReport& alert) {
  if (alert.level == record::AlertLevel::kClear) {
    in_force_.erase(alert.id);
  } else {
    in_force_[alert.id] = alert;
  }
}

void AlertFollower::complete(AlertNow& alert) const {
  alert.of.reset();
  for (const auto& [id, report] : in_force_) {
    if (report.level != alert.beat.level || !report.has_place()) continue;
    if (!alert.of || report.distance < alert.of->distance) alert.of = report;
  }
  alert.colour = alert.of && alert.of->signature != 0 ? name_of(alert.of->signature) : "";
}

std::string AlertFollower::name_of(std::uint8_t signature) const {
  const auto found = names_.find(signature);
  return found != names_.end() && !found->second.empty() ? found->second : std::to_string(signature);
}

}  // namespace fencepost::host
