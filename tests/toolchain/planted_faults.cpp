// One fault of each kind that the traps of toolchain/test are for (FENCEPOST_TRAPS); without an argument, none.
#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <string_view>

int main(int count, char** arguments) {
  const std::string_view fault = count > 1 ? arguments[1] : "";
  std::array<int, 4> values{1, 2, 3, 4};
  const std::size_t place = fault == "outside" ? values.size() : 0;
  int plain[4] = {1, 2, 3, 4};  // NOLINT(modernize-avoid-c-arrays)
  const std::size_t plain_place = fault == "outside_plain" ? values.size() : 0;
  const int large = fault == "overflow" ? std::numeric_limits<int>::max() : 0;
  const unsigned bits = fault == "shift" ? 32 : 0;
  const int sum = std::span(values)[place] + plain[plain_place] + (large + 1) + (1 << bits);
  return sum > 0 && fault.empty() ? 0 : 1;
}
