// The first 192 bytes of the cartridge (GBATEK, GBA Cartridge Header). The BIOS of a real console compares 156 of them
// with its maker's picture, which is not ours to hand out: they are zeros here, and the user's own flashing tool (a
// gbafix) fills them in. Emulators do not look.
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace fencepost::board {
namespace {

struct Header {
  std::uint32_t branch = 0xEA00'002E;  ///< to the byte after this header, in ARM state
  std::array<std::uint8_t, 156> picture{};
  std::array<char, 12> title{};
  std::array<char, 4> code{};
  std::array<char, 2> maker{};
  std::uint8_t fixed = 0x96;
  std::array<std::uint8_t, 9> zeros{};
  std::uint8_t version = 0;
  std::uint8_t check = 0;
  std::array<std::uint8_t, 2> end{};
};
static_assert(sizeof(Header) == 0xC0);

template <std::size_t N>
constexpr void put(std::array<char, N>& field, std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i) field[i] = text[i];
}

constexpr Header make_header() {
  Header header;
  put(header.title, "FENCEPOST");
  put(header.code, "AFPE");
  put(header.maker, "00");
  // The sum of 0xA0..0xBC and of this is 0xE7: what the BIOS asks for.
  int sum = 0x19 + header.fixed + header.version;
  for (const char c : header.title) sum += c;
  for (const char c : header.code) sum += c;
  for (const char c : header.maker) sum += c;
  header.check = static_cast<std::uint8_t>(-sum);
  return header;
}

}  // namespace

[[gnu::section(".header"), gnu::used]] extern constinit const Header header = make_header();

}  // namespace fencepost::board
