// libFuzzer's own mutations, and then the checksums of FENCEPOST_SEAL's protocol put right. One input in eight is left
// as it is: damage has to be tried, too.
#include <cstddef>
#include <cstdint>

#include "tests/drivers/seal/seal.hpp"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  size = LLVMFuzzerMutate(data, size, most);
  if (seed % 8 != 0) fencepost::test::FENCEPOST_SEAL({data, size});
  return size;
}
