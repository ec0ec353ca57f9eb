// Prints the same as `fencepost replay --json LOG`.
#include <fencepost/replay.hpp>
#include <fstream>
#include <iostream>
#include <iterator>

int main(int argc, char** argv) {
  std::ifstream file(argc > 1 ? argv[1] : "", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  const fencepost::Replayed run = fencepost::replay(bytes);
  std::cout << run.document;
  std::cerr << run.error;
  return run.error.empty() ? 0 : 1;
}
