// Foreign text made fit to be quoted in an answer: short and printable.
#pragma once

#include <string_view>

#include "hal/base/fixed.hpp"

namespace fencepost::console {

inline constexpr std::size_t kMaxQuote = 16;
using Quote = base::FixedString<kMaxQuote>;

/// Cut words end in "..", bytes that are not printable ASCII become '?'.
constexpr Quote quote(std::string_view word) {
  constexpr std::string_view kCut = "..";
  const bool cut = word.size() > kMaxQuote;
  const std::size_t kept = cut ? kMaxQuote - kCut.size() : word.size();
  Quote result;
  for (std::size_t i = 0; i < kept; ++i) {
    static_cast<void>(result.push_back(word[i] >= ' ' && word[i] <= '~' ? word[i] : '?'));
  }
  for (std::size_t i = 0; cut && i < kCut.size(); ++i) static_cast<void>(result.push_back(kCut[i]));
  return result;
}

}  // namespace fencepost::console
