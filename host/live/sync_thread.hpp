// Syncs files to the disk without blocking the loop: an SD card may take seconds.
#pragma once

#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

#include "hal/linux/descriptor.hpp"

namespace fencepost::host {

class SyncThread {
 public:
  SyncThread();
  /// Waits for pending syncs.
  ~SyncThread();
  SyncThread(const SyncThread&) = delete;
  SyncThread& operator=(const SyncThread&) = delete;

  /// fdatasync(2) of a file, fsync(2) of a folder; then closes the descriptor, which is why it takes one of its own.
  void sync(linux::Descriptor descriptor);
  /// Something asked for is not done yet.
  [[nodiscard]] bool busy() const;
  /// Waits until all is done. Answers the first error since the start (errno), or 0.
  int drain();
  /// The first error since the start (errno), or 0.
  [[nodiscard]] int error() const;

 private:
  void run();

  mutable std::mutex mutex_;  ///< guards the members up to `thread_`
  std::condition_variable changed_;
  std::deque<linux::Descriptor> due_;
  bool working_ = false;
  bool stop_ = false;
  int error_ = 0;
  std::thread thread_;  ///< last, so that it starts when the others are there
};

}  // namespace fencepost::host
