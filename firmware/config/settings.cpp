#include "firmware/config/settings.hpp"

#include <algorithm>

#include "firmware/record/decimal.hpp"

namespace fencepost::config {
namespace {

float power_of_ten(std::int32_t n) {
  float value = 1;
  for (; n > 0; --n) value *= 10;
  return value;
}

constexpr std::array<std::string_view, 3> kChoices = {"off", "on", "auto"};

}  // namespace

float Settings::number(Key key) const { return static_cast<float>(raw(key)) / power_of_ten(info(key).decimals); }

std::optional<SettingError> Settings::set(std::string_view key, std::string_view value) {
  for (std::size_t i = 0; i < kKeys; ++i) {
    const KeyInfo& entry = kKeyInfo[i];
    if (entry.name != key) continue;
    if (entry.unit == kChoice) {
      const auto choice = std::find(kChoices.begin(), kChoices.end(), value);
      if (choice == kChoices.end()) return SettingError::kNotANumber;
      values_[i] = static_cast<std::int32_t>(choice - kChoices.begin());
      return std::nullopt;
    }
    const auto number = record::read_decimal(value, {entry.low, entry.high, static_cast<std::uint8_t>(entry.decimals)});
    if (!number) {
      return number.error() == record::Reject::kRange ? SettingError::kOutOfRange : SettingError::kNotANumber;
    }
    values_[i] = static_cast<std::int32_t>(*number);
    return std::nullopt;
  }
  return SettingError::kUnknownKey;
}

sensor::Text Settings::text(Key key) const {
  const KeyInfo& entry = info(key);
  if (entry.unit == kChoice) return kChoices[static_cast<std::size_t>(raw(key))];
  std::array<char, record::kMaxDecimal> digits{};
  const std::size_t size = record::write_decimal(raw(key), static_cast<unsigned>(entry.decimals), digits);
  return std::string_view{digits.data(), size};
}

}  // namespace fencepost::config
