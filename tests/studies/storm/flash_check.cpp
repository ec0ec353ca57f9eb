#include "tests/studies/storm/flash_check.hpp"

#include "firmware/config/settings_store.hpp"
#include "tests/firmware/record/lines.hpp"

namespace fencepost::test {
namespace {

std::string line_of_setting(const config::Settings& settings, config::Key key) {
  return record::sealed("FPCFG," + std::string(config::info(key).name) + "," + std::string(settings.text(key).view()));
}

// The settings of one that differ from the other's, and whether anything else does.
std::vector<config::Key> changed(const Kept& one, const Kept& other) {
  std::vector<config::Key> keys;
  for (std::size_t i = 0; i < config::kKeys; ++i) {
    const auto key = static_cast<config::Key>(i);
    if (one.settings.raw(key) != other.settings.raw(key)) keys.push_back(key);
  }
  return keys;
}

std::string differences(const Kept& restored, const Kept& configured) {
  std::string text;
  for (const config::Key key : changed(restored, configured)) {
    text += " " + std::string(config::info(key).name) + " " + std::string(restored.settings.text(key).view()) +
            " for " + std::string(configured.settings.text(key).view()) + ",";
  }
  if (!(restored.camera == configured.camera)) text += " another calibration,";
  if (restored.signatures != configured.signatures) text += " other signatures,";
  text.pop_back();
  return text;
}

void append(StormFlash& flash, const std::string& line) {
  config::SettingsStore<StormFlash> store(flash);
  store.load([](std::string_view) {});
  static_cast<void>(store.append([&](auto& put) { put(line); }));
}

}  // namespace

void FlashCheck::note(const Kept& kept) {
  if (states_.back() == kept) return;
  constexpr std::size_t kMax = 2;
  if (states_.size() == kMax) states_.erase(states_.begin());
  states_.push_back(kept);
}

std::optional<std::string> FlashCheck::compare(const Kept& restored, bool in_write) const {
  if (restored == states_.back() || (in_write && restored == states_.front())) return std::nullopt;
  if (!in_write) return "what was in flash is not there after the power cut:" + differences(restored, states_.back());
  return "neither as before nor as after the write that the power cut ended:" + differences(restored, states_.front()) +
         "; and" + differences(restored, states_.back());
}

std::optional<std::string> FlashCheck::one_of_several() const {
  const Kept& after = states_.back();
  const std::vector<config::Key> keys = changed(states_.front(), after);
  if (keys.size() < 2) return std::nullopt;
  return line_of_setting(after.settings, keys.front());
}

void plant_mixture(StormFlash& flash) { append(flash, record::sealed("FPCFG,alert.stop,7.77")); }
void plant_half(StormFlash& flash, const std::string& line) { append(flash, line); }

}  // namespace fencepost::test
