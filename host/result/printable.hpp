// Makes text from logs and scenes safe for terminals: it must not move the cursor or change colours.
#pragma once

#include <string>
#include <string_view>

namespace fencepost::host {

/// Control characters become '?'; all else, UTF-8 included, stays.
inline std::string printable(std::string_view text) {
  std::string clean(text);
  for (char& c : clean) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7F) c = '?';
  }
  return clean;
}

}  // namespace fencepost::host
