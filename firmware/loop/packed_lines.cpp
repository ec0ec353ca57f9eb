#include "firmware/loop/packed_lines.hpp"

#include <algorithm>

namespace fencepost::loop {

std::string_view unpack_line(std::span<const std::uint8_t> packed, std::uint16_t& at, std::span<char> room) {
  std::size_t size = 0;
  bool piece = false;
  while (std::size_t{at} / 2 < packed.size()) {
    const std::size_t code = (static_cast<unsigned>(packed[at / 2]) >> (at % 2 * 4U)) & 0xFU;
    ++at;
    if (!piece && code == kPieceFollows) {
      piece = true;
      continue;
    }
    if (piece && code >= kPackedPieces.size()) return {};
    const std::string_view text = piece ? kPackedPieces[code] : std::string_view(&kPackedCharacters[code], 1);
    piece = false;
    if (text == "\n") return {room.data(), size};
    if (text.size() > room.size() - size) return {};
    std::copy(text.begin(), text.end(), room.begin() + static_cast<std::ptrdiff_t>(size));
    size += text.size();
  }
  return {};
}

}  // namespace fencepost::loop
