// The C library's functions on memory, by words. newlib's small ones go byte by byte, and the loop copies frames of
// some 500 bytes each turn. Unaligned pieces fall back to bytes: a Cortex-M0 cannot read words there.
#include <cstddef>
#include <cstdint>

extern "C" {
void* memcpy(void* __restrict to, const void* __restrict from, std::size_t size);
void* memset(void* to, int value, std::size_t size);
}

namespace {

// Words that may hold anything.
using Word [[gnu::may_alias]] = std::uint32_t;

bool both_aligned(const void* a, const void* b) {
  return ((reinterpret_cast<std::uintptr_t>(a) | reinterpret_cast<std::uintptr_t>(b)) % sizeof(Word)) == 0;
}

}  // namespace

// The compiler must not make calls of themselves of these loops.
[[gnu::optimize("no-tree-loop-distribute-patterns")]] void* memcpy(void* __restrict to, const void* __restrict from,
                                                                   std::size_t size) {
  auto* byte_to = static_cast<std::uint8_t*>(to);
  const auto* byte_from = static_cast<const std::uint8_t*>(from);
  if (both_aligned(to, from)) {
    for (; size >= 4 * sizeof(Word); size -= 4 * sizeof(Word)) {
      auto* word_to = static_cast<Word*>(static_cast<void*>(byte_to));
      const auto* word_from = static_cast<const Word*>(static_cast<const void*>(byte_from));
      word_to[0] = word_from[0];
      word_to[1] = word_from[1];
      word_to[2] = word_from[2];
      word_to[3] = word_from[3];
      byte_to += 4 * sizeof(Word);
      byte_from += 4 * sizeof(Word);
    }
  }
  for (; size > 0; --size) *byte_to++ = *byte_from++;
  return to;
}

[[gnu::optimize("no-tree-loop-distribute-patterns")]] void* memset(void* to, int value, std::size_t size) {
  auto* byte_to = static_cast<std::uint8_t*>(to);
  const auto byte = static_cast<std::uint8_t>(value);
  if (both_aligned(to, to)) {
    const Word word = byte * 0x0101'0101U;
    for (; size >= 2 * sizeof(Word); size -= 2 * sizeof(Word)) {
      auto* word_to = static_cast<Word*>(static_cast<void*>(byte_to));
      word_to[0] = word;
      word_to[1] = word;
      byte_to += 2 * sizeof(Word);
    }
  }
  for (; size > 0; --size) *byte_to++ = byte;
  return to;
}
