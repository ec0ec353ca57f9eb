// The name and look of a signature, as the camera was taught it.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "firmware/record/records.hpp"

namespace fencepost::console {

/// nullptr where nothing is known of it.
inline const record::Signature* find_signature(std::uint8_t signature, std::span<const record::Signature> all) {
  for (const record::Signature& known : all) {
    if (known.signature == signature) return &known;
  }
  return nullptr;
}

/// Its name, or empty.
inline std::string_view name_of(std::uint8_t signature, std::span<const record::Signature> all) {
  const record::Signature* known = find_signature(signature, all);
  return known != nullptr ? known->name.view() : std::string_view();
}

}  // namespace fencepost::console
