// Record lines in less than half their bytes. They are nearly all digits, so a character takes a code of four bits.
// Code 15 announces one of up to sixteen pieces. The self-test's stream is packed when it is compiled.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace fencepost::loop {

inline constexpr std::string_view kPackedCharacters = "0123456789,.-*\n";  ///< codes 0 to 14
inline constexpr std::uint8_t kPieceFollows = 15;                          ///< one more code follows, of a piece
inline constexpr std::array<std::string_view, 12> kPackedPieces = {
    "A", "B", "C", "D", "E", "F", "$FPODO,", "$FPFRM,", "$FPCAM,", "selftest", "d02020", "2040d0"};
static_assert(kPackedCharacters.size() == kPieceFollows && kPackedPieces.size() <= 16);

/// Puts codes, two to a byte, the first of them into the lower half; counts on where there is no room.
class CodeWriter {
 public:
  explicit constexpr CodeWriter(std::span<std::uint8_t> out) : out_(out) {}

  constexpr void put(std::size_t code) {
    const std::size_t byte = count_ / 2;
    if (byte < out_.size()) {
      const auto half = static_cast<std::uint8_t>(code);
      out_[byte] = count_ % 2 == 0 ? half : static_cast<std::uint8_t>(out_[byte] | half << 4U);
    }
    ++count_;
  }
  [[nodiscard]] constexpr std::size_t bytes() const { return (count_ + 1) / 2; }

 private:
  std::span<std::uint8_t> out_;
  std::size_t count_ = 0;
};

/// The codes that a character may begin. A table, because compilers bound the steps of a constant expression.
struct FirstCharacter {
  std::uint8_t code = kPieceFollows;  ///< the character's own; kPieceFollows if it has none
  bool begins_piece = false;
};

inline constexpr std::array<FirstCharacter, 128> kFirstCharacters = [] {
  std::array<FirstCharacter, 128> table{};
  table.fill(FirstCharacter{});  // g++ 12 forgets elements' defaults where the library's checks are on
  for (std::size_t i = 0; i < kPackedCharacters.size(); ++i) {
    table[static_cast<unsigned char>(kPackedCharacters[i])].code = static_cast<std::uint8_t>(i);
  }
  for (const std::string_view piece : kPackedPieces) {
    table[static_cast<unsigned char>(piece.front())].begins_piece = true;
  }
  return table;
}();

/// Which piece `text` begins with; their number if none.
constexpr std::size_t piece_at_front(std::string_view text) {
  std::size_t i = 0;
  while (i < kPackedPieces.size() && !text.starts_with(kPackedPieces[i])) ++i;
  return i;
}

/// Packs `text` into `out`, as far as there is room, and returns the bytes that all of it takes. 0 if it has a
/// character without a code. A text of whole lines ends with '\n'.
constexpr std::size_t pack_lines(std::string_view text, std::span<std::uint8_t> out) {
  CodeWriter codes(out);
  for (std::size_t at = 0; at < text.size();) {
    const auto byte = static_cast<unsigned char>(text[at]);
    const FirstCharacter first = byte < kFirstCharacters.size() ? kFirstCharacters[byte] : FirstCharacter{};
    const std::size_t piece = first.begins_piece ? piece_at_front(text.substr(at)) : kPackedPieces.size();
    if (piece < kPackedPieces.size()) {
      codes.put(kPieceFollows);
      codes.put(piece);
      at += kPackedPieces[piece].size();
    } else if (first.code != kPieceFollows) {
      codes.put(first.code);
      ++at;
    } else {
      return 0;
    }
  }
  return codes.bytes();
}

/// The line that begins at code `at` of `packed`, without its end, in `room`; moves `at` behind it. Empty at the end of
/// all, or where there is no room for the line.
std::string_view unpack_line(std::span<const std::uint8_t> packed, std::uint16_t& at, std::span<char> room);

}  // namespace fencepost::loop
