// Prints one line per digest that must not depend on compiler, optimisation or sanitizer; toolchain/matrix compares.
#include <cinttypes>
#include <cstdio>

#include "tests/probe/trig_digest.hpp"

int main() {
  std::uint64_t trig = fencepost::probe::trig_digest();
#ifdef FENCEPOST_PLANT_DIFFERENCE
  ++trig;  // the matrix proves on this that it can fail
#endif
  std::printf("trig %016" PRIx64 "\n", trig);
  return 0;
}
