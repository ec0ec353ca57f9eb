// One request on its way out over a link that may take a part of it at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/base/fixed.hpp"
#include "hal/bus/byte_link.hpp"

namespace fencepost::wire {

template <std::size_t Capacity>
class Outbox {
 public:
  using Bytes = base::FixedVector<std::uint8_t, Capacity>;

  /// Replaces what was not yet sent.
  void put(const Bytes& bytes) {
    bytes_ = bytes;
    sent_ = 0;
  }
  void clear() { sent_ = bytes_.size(); }
  [[nodiscard]] bool empty() const { return sent_ == bytes_.size(); }

  /// Sends what the link takes now. False: the link is gone.
  template <bus::ByteLink Link>
  bool flush(Link& link) {
    if (empty()) return true;
    const base::Result<std::size_t> taken = link.write(bytes_.view().subspan(sent_));
    if (taken) sent_ += *taken;
    return taken || taken.error() != base::Error::kGone;
  }

 private:
  Bytes bytes_;
  std::size_t sent_ = 0;
};

}  // namespace fencepost::wire
