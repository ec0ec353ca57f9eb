#include "host/live/calibration_lines.hpp"

#include <algorithm>
#include <array>
#include <charconv>

namespace fencepost::host {
namespace {

/// The first field of a record's line.
std::string_view first_field(std::string_view line) {
  const std::size_t begin = line.find(',');
  if (begin == std::string_view::npos) return {};
  line.remove_prefix(begin + 1);
  return line.substr(0, line.find(','));
}

}  // namespace

bool CalibrationLines::is_one(std::string_view line) {
  constexpr std::array<std::string_view, 4> kKinds = {"$FPHDR,", "$FPCAM,", "$FPSIG,", "$FPCFG,"};
  return std::any_of(kKinds.begin(), kKinds.end(), [&](std::string_view kind) { return line.starts_with(kind); });
}

void CalibrationLines::note(std::string_view line) {
  if (line.starts_with("$FPHDR,")) {
    camera_.clear();
    signatures_.clear();
    settings_.clear();
  } else if (line.starts_with("$FPCAM,")) {
    camera_ = line;
  } else if (line.starts_with("$FPSIG,")) {
    const std::string_view field = first_field(line);
    int number = 0;
    std::from_chars(field.data(), field.data() + field.size(), number);
    signatures_[number] = line;
  } else if (line.starts_with("$FPCFG,")) {
    settings_[std::string(first_field(line))] = line;
  }
}

std::string CalibrationLines::in_force() const {
  std::string text = camera_;
  for (const auto& [number, line] : signatures_) text += line;
  for (const auto& [key, line] : settings_) text += line;
  return text;
}

}  // namespace fencepost::host
