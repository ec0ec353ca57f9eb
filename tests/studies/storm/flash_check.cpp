#include "tests/studies/storm/flash_check.hpp"

#include <algorithm>

#include "firmware/config/settings_store.hpp"
#include "tests/firmware/record/lines.hpp"

namespace fencepost::test {

void FlashCheck::remember(const Kept& kept) {
  constexpr std::size_t kMost = 2;
  if (remembered_.size() == kMost) remembered_.erase(remembered_.begin());
  remembered_.push_back(kept);
}

void FlashCheck::note(const Kept& kept) {
  if (noted_.empty() || !(noted_.back() == kept)) noted_.push_back(kept);
}

std::optional<std::string> FlashCheck::compare(const Kept& restored) const {
  std::vector<Kept> all = remembered_;
  all.insert(all.end(), noted_.begin(), noted_.end());
  if (remembered_.size() < 2) return std::nullopt;  // it may not have kept anything yet
  const auto any = [&all](auto&& is) { return std::any_of(all.begin(), all.end(), is); };
  for (std::size_t i = 0; i < config::kKeys; ++i) {
    const auto key = static_cast<config::Key>(i);
    if (any([&](const Kept& kept) { return kept.settings.raw(key) == restored.settings.raw(key); })) continue;
    return std::string(config::info(key).name) + " is " + std::string(restored.settings.text(key).view()) +
           ", which it never was before the power cut";
  }
  if (!any([&](const Kept& kept) { return kept.camera == restored.camera; })) {
    return "the camera's calibration is none that it had before the power cut";
  }
  if (!any([&](const Kept& kept) { return kept.signatures.size() <= restored.signatures.size(); })) {
    return "signatures are missing after the power cut";
  }
  for (const record::Signature& signature : restored.signatures) {
    const auto has = [&](const Kept& kept) {
      return std::find(kept.signatures.begin(), kept.signatures.end(), signature) != kept.signatures.end();
    };
    if (!any(has))
      return "signature " + std::to_string(signature.signature) + " is none that it had before the power cut";
  }
  return std::nullopt;
}

void plant_mixture(StormFlash& flash) {
  config::SettingsStore<StormFlash> store(flash);
  store.load([](std::string_view) {});
  static_cast<void>(store.append(record::sealed("FPCFG,alert.stop,7.77")));
}

}  // namespace fencepost::test
