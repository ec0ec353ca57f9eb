// A log while it is written, for several readers at their own pace.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <string>
#include <string_view>

#include "host/live/calibration_lines.hpp"

namespace fencepost::host {

/// The newest lines, within a bound. One thread adds, another reads.
class GrowingLog {
 public:
  /// An hour of most robots.
  static constexpr std::size_t kCapacity = 32 << 20;

  explicit GrowingLog(std::size_t capacity = kCapacity);
  GrowingLog(const GrowingLog&) = delete;
  GrowingLog& operator=(const GrowingLog&) = delete;

  /// Whole lines. Never waits for a reader: those that are too far behind lose their place.
  void add(std::string_view lines);
  /// Nothing follows.
  void end();

  /// The text before the first part, and that part's place.
  struct Start {
    std::string preamble;  ///< empty, or what was in force when the oldest kept line came, with its run's header
    std::uint64_t place = 0;
  };
  [[nodiscard]] Start start() const;

  struct Part {
    std::string bytes;        ///< empty: nothing new
    std::uint64_t place = 0;  ///< of the next one
    bool lost = false;        ///< the bytes of this place are not kept any more
    bool ended = false;       ///< and nothing follows
  };
  [[nodiscard]] Part read(std::uint64_t place) const;

 private:
  struct Block {
    std::uint64_t begin = 0;
    std::string text;  ///< whole lines
  };
  void forget_oldest();

  const std::size_t capacity_;
  const std::size_t block_;   ///< bytes from which on the next one begins
  mutable std::mutex mutex_;  ///< of all below, held for a copy of a block at most
  std::deque<Block> blocks_;
  std::uint64_t end_ = 0;
  bool ended_ = false;
  std::string header_;  ///< FPHDR of the run in which the oldest kept line is
  CalibrationLines before_;
};

}  // namespace fencepost::host
