// Complaints about a log, each sentence once, however often the log gives rise to it.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

namespace fencepost::host {

class Complaints {
 public:
  /// More different ones than these only a hostile log has.
  static constexpr std::size_t kMax = 100;

  void add(const std::string& sentence) {
    if (all_.size() == kMax || std::find(all_.begin(), all_.end(), sentence) != all_.end()) return;
    all_.push_back(sentence);
  }
  void add(const std::vector<std::string>& sentences) {
    for (const std::string& sentence : sentences) add(sentence);
  }
  [[nodiscard]] const std::vector<std::string>& all() const { return all_; }

 private:
  std::vector<std::string> all_;
};

}  // namespace fencepost::host
