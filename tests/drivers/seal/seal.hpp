// Checksums put right: what a fuzzer or a hand wrote becomes messages that a decoder believes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace fencepost::test {

/// Finds what looks like messages of a protocol in `bytes` and writes each one's checksum over what stands there. What
/// is cut off at the end, or too long for the protocol, stays.
using Seal = void (*)(std::span<std::uint8_t> bytes);

inline std::vector<std::uint8_t> sealed(std::vector<std::uint8_t> bytes, Seal seal) {
  seal(bytes);
  return bytes;
}

void seal_create(std::span<std::uint8_t> bytes);
void seal_huskylens(std::span<std::uint8_t> bytes);
void seal_nxtcam5(std::span<std::uint8_t> bytes);
void seal_pixy1(std::span<std::uint8_t> bytes);
void seal_pixy2(std::span<std::uint8_t> bytes);
/// Lines with a star and two digits at their end.
void seal_xbc(std::span<std::uint8_t> bytes);
/// Lines of the record stream: a star and four digits at their end.
void seal_records(std::span<std::uint8_t> bytes);

}  // namespace fencepost::test
