// A fuzzer's entry of each driver's test program, run shortly, so that it cannot rot.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <random>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace fencepost::test {
namespace {

// Marks, digits and letters of all protocols, between bytes of any value.
constexpr std::array<std::uint8_t, 32> kMeaningful = {0x00, 0x01, 0x02, 0x04, 0x0A, 0x0D, 0x11, 0x13, 0x14, 0x18, 0x21,
                                                      0x29, 0x2A, 0x2B, 0x2C, 0x40, 0x55, 0x55, 0xAA, 0xAA, 0xAF, 0xC1,
                                                      0xFE, 0xFF, ' ',  '$',  '*',  '0',  '7',  'B',  'F',  'T'};

TEST(Fuzzer, RunsShortly) {
  std::mt19937 random(1);
  for (int run = 0; run < 2'000; ++run) {
    std::vector<std::uint8_t> bytes(random() % 512);
    for (std::uint8_t& byte : bytes) {
      const std::uint64_t drawn = random() >> 8U;
      byte = drawn % 4 == 0 ? static_cast<std::uint8_t>(drawn >> 8U) : kMeaningful[(drawn >> 8U) % kMeaningful.size()];
    }
    ASSERT_EQ(LLVMFuzzerTestOneInput(bytes.data(), bytes.size()), 0);
  }
}

}  // namespace
}  // namespace fencepost::test
