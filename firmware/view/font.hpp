// Letters of 5 x 7 pixels, drawn for this project. Small letters look like capitals; what is missing is a question
// mark.
#pragma once

#include <cstddef>
#include <cstdint>

namespace fencepost::view {

inline constexpr std::size_t kLetterWidth = 5;
inline constexpr std::size_t kLetterHeight = 7;
inline constexpr std::size_t kLetterPitch = 6;  ///< from one to the next

/// Five pixels of one row, the left one in bit 4. `row` < kLetterHeight.
std::uint8_t letter_row(char letter, std::size_t row);

}  // namespace fencepost::view
