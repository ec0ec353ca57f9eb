// Paths are made of UTF-8. libstdc++ makes them by mbrtowc(), and the C library of Windows knows no locale of UTF-8.
// The linker puts this in its place (--wrap).
#include <cstddef>
#include <cstdint>
#include <cwchar>

namespace {

constexpr auto kBad = static_cast<std::size_t>(-1);
constexpr auto kCutOff = static_cast<std::size_t>(-2);
constexpr std::uint32_t kBeyondOneUnit = 0x10000;

/// Bytes of the character that begins so; 0: none begins so.
std::size_t length_of(unsigned char first) {
  if (first < 0x80) return 1;
  if (first < 0xC2) return 0;
  return first < 0xE0 ? 2 : first < 0xF0 ? 3 : first < 0xF5 ? 4 : 0;
}

std::uint32_t bits(const char* byte) { return static_cast<unsigned char>(*byte) & 0x3FU; }

}  // namespace

/// Of a character of two units the first takes three bytes; `state` is the second until its byte comes.
extern "C" std::size_t __wrap_mbrtowc(wchar_t* to, const char* from, std::size_t size, std::mbstate_t* state) {
  if (from == nullptr) return 0;
  if (size == 0) return kCutOff;
  if (*state != 0) {
    if (to != nullptr) *to = static_cast<wchar_t>(*state);
    *state = 0;
    return 1;
  }
  const auto first = static_cast<unsigned char>(*from);
  const std::size_t length = length_of(first);
  if (length == 0) return kBad;
  if (size < length) return kCutOff;
  std::uint32_t code = length == 1 ? first : first & (0xFFU >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((static_cast<unsigned char>(from[i]) & 0xC0U) != 0x80U) return kBad;
    code = code << 6U | bits(from + i);
  }
  if (code >= kBeyondOneUnit) {
    code -= kBeyondOneUnit;
    *state = static_cast<std::mbstate_t>(0xDC00U + (code & 0x3FFU));
    code = 0xD800U + (code >> 10U);
  }
  if (to != nullptr) *to = static_cast<wchar_t>(code);
  return code == 0 ? 0 : length == 4 ? 3 : length;
}
