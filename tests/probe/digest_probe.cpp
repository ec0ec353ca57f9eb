// Prints one line per digest that must not depend on compiler, optimisation or sanitizer; toolchain/matrix compares.
#include <cinttypes>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>

#include "host/replay/replay.hpp"
#include "tests/probe/trig_digest.hpp"

namespace {

bool print_replay(const std::string& name, const char* profile) {
  const std::string path = FENCEPOST_RECORDINGS "/" + name + ".log";
  std::ifstream file(path, std::ios::binary);
  std::stringstream bytes;
  bytes << file.rdbuf();
  fencepost::host::ReplayOptions options;
  options.profile = profile;
  const fencepost::host::ReplayOutcome outcome = fencepost::host::replay(bytes.str(), path, options);
  if (outcome.unreadable) {
    std::fprintf(stderr, "%s\n", outcome.unreadable->message.c_str());
    return false;
  }
  std::printf("%s %s %016" PRIx64 "\n", name.c_str(), profile, outcome.result.digest);
  return true;
}

}  // namespace

int main() {
  std::uint64_t trig = fencepost::probe::trig_digest();
#ifdef FENCEPOST_PLANT_DIFFERENCE
  ++trig;  // the matrix proves on this that it can fail
#endif
  std::printf("trig %016" PRIx64 "\n", trig);
  for (const char* name : {"approach_stop", "blocks_arc", "corridor", "noisy_arc"}) {
    for (const char* profile : {"micro", "small", "full"}) {
      if (!print_replay(name, profile)) return 1;
    }
  }
  return 0;
}
