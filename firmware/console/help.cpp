#include "firmware/console/help.hpp"

namespace fencepost::console {

namespace {

constexpr std::size_t kIndent = 2;

std::size_t write_verb(const VerbInfo& verb, std::span<char> out) {
  constexpr std::size_t kHelpColumn = 28;
  Sentence s(out);
  s.pad_to(kIndent).put(verb.name).put(" ").put(verb.arguments).gap_to(kHelpColumn).put(verb.help);
  return s.end();
}

// `value`: as text.
Sentence& put_row(Sentence& s, const config::KeyInfo& entry, std::string_view value) {
  constexpr std::size_t kValueEnds = 22;
  s.pad_to(kIndent).put(entry.name);
  return s.gap_to(value.size() < kValueEnds ? kValueEnds - value.size() : 0).put(value);
}
constexpr std::size_t kRangeColumn = 24;
constexpr std::size_t kHelpColumn = 38;

template <class Id, std::size_t N>
void put_names(Sentence& s, const std::array<config::DeviceInfo, N>& all, const config::DeviceLimits& limits) {
  bool first = true;
  for (std::size_t i = 0; i < N; ++i) {
    if (!limits.contains(static_cast<Id>(i))) continue;
    s.put(first ? "" : "|").put(all[i].name);
    first = false;
  }
}

}  // namespace

void put_range(Sentence& s, const config::KeyInfo& entry) {
  if (entry.unit == config::kChoice) {
    s.put(entry.unit);
    return;
  }
  const auto decimals = static_cast<unsigned>(entry.decimals);
  s.number(entry.low, decimals).put("..").number(entry.high, decimals);
  if (!entry.unit.empty()) s.put(" ").put(entry.unit);
}

void put_choice(Sentence& s, config::DeviceKey key, const config::DeviceLimits& limits) {
  if (key == config::DeviceKey::kCamera) return put_names<config::CameraId>(s, config::kCameras, limits);
  if (key == config::DeviceKey::kOdometry) return put_names<config::OdometryId>(s, config::kOdometries, limits);
  put_range(s, config::info(key));
}

std::size_t write_setting(std::size_t line, const SettingsInForce& in_force, std::span<char> out) {
  Sentence s(out);
  const bool of_device = line >= config::kKeys;
  const config::KeyInfo& entry = of_device ? config::kDeviceInfo[line - config::kKeys] : config::kKeyInfo[line];
  const sensor::Text value = of_device ? in_force.devices.text(static_cast<config::DeviceKey>(line - config::kKeys))
                                       : in_force.settings.text(static_cast<config::Key>(line));
  put_row(s, entry, value.view()).gap_to(kRangeColumn);
  if (entry.unit != config::kDeviceName) put_range(s, entry);  // its names would not fit: the error lists them
  s.gap_to(kHelpColumn).put(entry.help);
  return s.end();
}

std::size_t write_help(std::size_t line, std::span<char> out) {
  if (line < kVerbs) return write_verb(kVerbInfo[line], out);
  return Sentence(out).put("  $FPODO $FPCAR $FPFRM $FPCAM $FPSIG records are inputs, as in a log").end();
}

}  // namespace fencepost::console
