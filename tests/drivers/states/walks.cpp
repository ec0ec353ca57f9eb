#include "tests/drivers/states/walks.hpp"

#include <tuple>

namespace fencepost::test {
namespace {

std::vector<NamedWalk>& registered() {
  static std::vector<NamedWalk> walks;
  return walks;
}

}  // namespace

RegisteredWalk::RegisteredWalk(std::string_view driver, std::string_view decoder, Walked (*run)()) {
  registered().push_back({driver, decoder, run});
}

const std::vector<NamedWalk>& named_walks() {
  std::sort(registered().begin(), registered().end(), [](const NamedWalk& a, const NamedWalk& b) {
    return std::tie(a.driver, a.decoder) < std::tie(b.driver, b.decoder);
  });
  return registered();
}

}  // namespace fencepost::test
