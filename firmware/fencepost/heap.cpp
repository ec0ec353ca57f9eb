// The only source of the library with a heap, for programs that ask for one: an object of its own in the archive.
#include <cstdlib>

#include "firmware/fencepost/fencepost.h"

fencepost_core* fencepost_create(const fencepost_capacity* capacity) {
  const std::size_t bytes = fencepost_bytes(capacity);
  if (bytes == 0) return nullptr;
  void* memory = std::malloc(bytes);  // NOLINT(cppcoreguidelines-no-malloc): aligned for anything
  return memory == nullptr ? nullptr : fencepost_init(memory, bytes, capacity);
}

void fencepost_destroy(fencepost_core* core) {
  std::free(core);  // NOLINT(cppcoreguidelines-no-malloc): what fencepost_create() got
}
