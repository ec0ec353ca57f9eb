// Requests of a host that the emulated device does not carry out.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace fencepost::emulate {

/// Each name once, in the order of first use.
class NotEmulated {
 public:
  void note(const std::string& name) {
    if (names_.size() < kMax && std::find(names_.begin(), names_.end(), name) == names_.end()) names_.push_back(name);
  }
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }

 private:
  static constexpr std::size_t kMax = 20;  ///< of a host at another baud rate there is no end

  std::vector<std::string> names_;
};

}  // namespace fencepost::emulate
