#include "tests/studies/hazards/cell.hpp"

namespace fencepost::test {

std::vector<Family> families() {
  return {walls(),   corridors(), passing(), approaches(), movers(), obeying(),
          removal(), bases(),     cameras(), turning(),    blind()};
}

}  // namespace fencepost::test
