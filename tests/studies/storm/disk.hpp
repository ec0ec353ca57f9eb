// A disk behind the desk's own writer, whose thread is held in step, so that a run is the same each time.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

#include "host/live/log_keeper.hpp"

namespace fencepost::test {

/// Shared by the writer's thread and the run.
struct Platter {
  std::mutex mutex;
  std::condition_variable changed;
  bool open = true;     ///< writes go on
  bool full = false;    ///< and fail
  bool inside = false;  ///< a write waits
  std::string bytes;
};

class Disk {
 public:
  Disk();
  ~Disk();
  Disk(const Disk&) = delete;
  Disk& operator=(const Disk&) = delete;

  /// The part of these whole lines that is dealt with, see host::LogKeeper.
  std::size_t take(std::string_view lines, base::Time now);
  void set_open(bool open);
  void set_full();
  [[nodiscard]] bool failed() const { return keeper_.failed(); }
  [[nodiscard]] bool behind() const { return keeper_.behind(); }
  /// All bytes that were written.
  [[nodiscard]] std::string bytes() const;

 private:
  void settle();

  static constexpr std::size_t kCapacity = 96 * 1024;  ///< of the writer: full after seconds, not minutes

  std::shared_ptr<Platter> platter_ = std::make_shared<Platter>();
  host::WriteBehind writer_;
  host::LogKeeper keeper_;
};

}  // namespace fencepost::test
