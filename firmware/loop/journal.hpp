// A second output: the log of the whole run, whatever the console shows. Only where there is memory and a disk for it.
#pragma once

#include <cstddef>
#include <span>
#include <type_traits>

#include "firmware/loop/output_queue.hpp"

namespace fencepost::loop {

/// A profile with a journal of kBytes.
template <class Base, std::size_t kBytes>
struct Journaled : Base {
  static constexpr std::size_t kJournalBytes = kBytes;
};

/// Lines on their way to the log's file. While it is on, an input is used only if its record is in here. The file
/// therefore holds exactly the inputs that were used, as with a console in mode log.
template <std::size_t N>
class Journal {
 public:
  /// `inputs`: the reader of the lines needs frames and odometry, too. A replay already has them in the log that it
  /// reads, and need not write them: any of them would have fitted.
  void start(bool inputs = true) {
    on_ = true;
    inputs_ = inputs;
  }
  /// The file cannot be written any more: the loop goes on without it.
  void stop() {
    on_ = false;
    queue_.taken(queue_.waiting().size());
  }
  [[nodiscard]] bool on() const { return on_; }

  /// False when there is no room now.
  template <class Record>
  [[nodiscard]] bool put(const Record& record) {
    if constexpr (std::is_same_v<Record, sensor::BlobFrame> || std::is_same_v<Record, sensor::OdometrySample>) {
      if (!inputs_) return has_room();
    }
    return queue_.put(record);
  }
  /// Any record fits.
  [[nodiscard]] bool has_room() const { return N - queue_.waiting().size() >= record::kMaxLine; }

  [[nodiscard]] std::span<const char> waiting() const { return queue_.waiting(); }
  void taken(std::size_t size) { queue_.taken(size); }

 private:
  bool on_ = false;
  bool inputs_ = true;
  OutputQueue<N> queue_;
};

/// There is none, and it costs nothing.
template <>
class Journal<0> {
 public:
  [[nodiscard]] static constexpr bool on() { return false; }
  [[nodiscard]] static constexpr bool has_room() { return false; }
  template <class Record>
  [[nodiscard]] static constexpr bool put(const Record& /*record*/) {
    return false;
  }
};

}  // namespace fencepost::loop
