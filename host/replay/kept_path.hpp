// Where the robot was, sample by sample; of a long drive evenly fewer, so that memory does not grow with the log.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "host/result/result.hpp"

namespace fencepost::host {

class KeptPath {
 public:
  /// At most `most` poses are kept (2 at least); nothing: all.
  explicit KeptPath(std::optional<std::size_t> most = {}) : most_(most) {}

  void clear() {
    kept_.clear();
    count_ = 0;
    step_ = 1;
  }

  void add(const PoseResult& pose) {
    last_ = pose;
    if (most_ && kept_.size() + 1 >= *most_ && count_ % step_ == 0) keep_every_other();
    if (count_++ % step_ == 0) kept_.push_back(pose);
  }

  /// The first and every n-th, n a power of two: 1 as long as there is room for all.
  [[nodiscard]] const std::vector<PoseResult>& poses() const { return kept_; }
  /// The same and the last one.
  [[nodiscard]] std::vector<PoseResult> to_the_end() const {
    std::vector<PoseResult> path = kept_;
    if (count_ > 0 && (count_ - 1) % step_ != 0) path.push_back(last_);
    return path;
  }
  /// Number of added poses.
  [[nodiscard]] std::uint64_t count() const { return count_; }
  [[nodiscard]] bool empty() const { return count_ == 0; }

 private:
  void keep_every_other() {
    for (std::size_t i = 0; 2 * i < kept_.size(); ++i) kept_[i] = kept_[2 * i];
    kept_.resize((kept_.size() + 1) / 2);
    step_ *= 2;
  }

  std::optional<std::size_t> most_;
  std::vector<PoseResult> kept_;
  PoseResult last_;
  std::uint64_t count_ = 0;
  std::uint64_t step_ = 1;
};

}  // namespace fencepost::host
