// libFuzzer's way in to the decoder with a fault behind its checksum: toolchain/long fuzz_planted has to find it.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "tests/drivers/states/planted.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fencepost::test::Planted<fencepost::test::kPlantedRoom + 1> decoder;
  for (std::size_t i = 0; i < size; ++i) {
    (void)decoder.feed(data[i]);
    if (!decoder.intact()) std::abort();
  }
  return 0;
}
