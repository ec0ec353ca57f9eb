// What `fencepost replay --json LOG` prints.
#include <fstream>
#include <iostream>
#include <iterator>

#include "host/replay/replay.hpp"
#include "host/result/to_json.hpp"

int main(int argc, char** argv) {
  std::ifstream file(argc > 1 ? argv[1] : "", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  const fencepost::host::ReplayOutcome outcome = fencepost::host::replay(bytes, "log", {});
  if (outcome.unreadable) return 1;
  std::cout << fencepost::host::to_json(outcome.result);
}
