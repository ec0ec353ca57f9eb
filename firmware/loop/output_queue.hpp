// Lines on their way to the console. A line is queued whole or not at all.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "firmware/record/encode.hpp"
#include "hal/base/fixed.hpp"

namespace fencepost::loop {

template <std::size_t N>
class OutputQueue {
  static_assert(N >= record::kMaxLine, "the longest line must fit");

 public:
  /// Queues the record's line; false when there is no room now.
  template <class Record>
  [[nodiscard]] bool put(const Record& record) {
    return put_line([&record](std::span<char> room) { return record::encode(record, room); });
  }

  /// Queues what `write(room)` writes; it returns the length, or 0 if the room is too small.
  template <class Write>
  [[nodiscard]] bool put_line(Write&& write) {
    std::size_t size = write(std::span<char>(bytes_).subspan(end_));
    if (size == 0 && begin_ > 0) {
      to_front();
      size = write(std::span<char>(bytes_).subspan(end_));
    }
    end_ = static_cast<Index>(end_ + size);
    return size > 0;
  }

  [[nodiscard]] std::span<const char> waiting() const { return std::span(bytes_).subspan(begin_, end_ - begin_); }
  /// The first `size` waiting bytes were accepted by the link.
  void taken(std::size_t size) {
    begin_ = static_cast<Index>(begin_ + size);
    if (begin_ == end_) begin_ = end_ = 0;
  }

 private:
  using Index = base::CountFor<N>;

  void to_front() {
    std::copy(bytes_.begin() + begin_, bytes_.begin() + end_, bytes_.begin());
    end_ = static_cast<Index>(end_ - begin_);
    begin_ = 0;
  }

  std::array<char, N> bytes_{};
  Index begin_ = 0;
  Index end_ = 0;
};

}  // namespace fencepost::loop
