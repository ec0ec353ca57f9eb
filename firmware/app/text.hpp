// Console mode `text`: one sentence a person understands.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "firmware/record/records.hpp"

namespace fencepost::app {

/// Any sentence fits into this many characters, line end included.
inline constexpr std::size_t kMaxSentence = 96;

/// "STOP    red  0.24 m  12 deg left  in 1.1 s\r\n". `name` is the signature's name, or empty. Returns the length,
/// 0 if `out` is too small.
std::size_t describe(const record::AlertReport& alert, std::string_view name, std::span<char> out);

}  // namespace fencepost::app
