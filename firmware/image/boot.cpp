#include "firmware/image/boot.hpp"

#include <array>
#include <cstdint>
#include <string_view>

#include "firmware/console/sentence.hpp"

namespace fencepost::image {
namespace {

console::Sentence& put_hex(console::Sentence& s, std::uint32_t value) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::array<char, 8> digits{};
  for (std::size_t i = 0; i < digits.size(); ++i) digits[i] = kDigits[(value >> (28 - 4 * i)) & 0xFU];
  return s.put({digits.data(), digits.size()});
}

void put_panic(console::Sentence& s, const std::optional<mcu::Panic>& panic) {
  if (!panic) {
    s.put("panic: none");
    return;
  }
  s.put("panic: exception ").number(panic->exception).put(" at ");
  put_hex(s, panic->pc).put(", called from ");
  put_hex(s, panic->lr);
}

}  // namespace

std::size_t write_boot_line(std::size_t n, const BootFacts& facts, std::span<char> out) {
  console::Sentence s(out);
  switch (n) {
    case 0:
      s.put(kProduct).put(" ").put(facts.version).put(" for ").put(facts.target);
      s.put(", profile ").put(facts.profile);
      break;
    case 1: s.put("reset: ").put(mcu::name(facts.panic ? mcu::ResetReason::kPanic : facts.reason)); break;
    case 2: put_panic(s, facts.panic); break;
    default: s.put("READY"); break;
  }
  return s.end();
}

}  // namespace fencepost::image
