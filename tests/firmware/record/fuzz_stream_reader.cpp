// libFuzzer's way in. The ordinary tests call it too, so it cannot rot where there is no libFuzzer.
#include <cstddef>
#include <cstdint>
#include <string>

#include "tests/firmware/record/stream_invariants.hpp"

// Fixes each line's CRC, which a fuzzer would hardly ever guess: without this it would never reach the fields.
static std::string resealed(const std::string& bytes) {
  std::string out;
  std::size_t at = 0;
  while (at < bytes.size()) {
    const std::size_t end = std::min(bytes.find('\n', at), bytes.size());
    const std::string line = bytes.substr(at, end - at);
    const std::size_t star = std::min(line.find('*'), line.size());
    out += line.starts_with('$') && star > 1 ? fencepost::record::sealed(line.substr(1, star - 1)) : line;
    if (end < bytes.size()) out += '\n';
    at = end + 1;
  }
  return out;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(data, data + size);
  fencepost::record::check_stream_invariants(bytes);
  fencepost::record::check_stream_invariants(resealed(bytes));
  return 0;
}
