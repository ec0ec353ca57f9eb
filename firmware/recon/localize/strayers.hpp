// Detects landmarks that move.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/recon/localize/tuning.hpp"

namespace fencepost::recon {

/// The objects that are no landmarks, because their innovations stay large whatever the pose. If two of the last four
/// such objects have one signature, no object of that signature is a landmark any more.
template <std::size_t kLandmarks>
class Strayers {
 public:
  void clear() {
    off_.fill(0);
    signatures_.fill(0);
    next_ = 0;
  }
  void forget(std::size_t slot) { off_[slot] = 0; }
  /// True if the object in `slot` is to be no landmark any more. `surprise`: of its last sighting, see DriftGauge.
  bool look(std::size_t slot, std::uint8_t signature, float surprise) {
    off_[slot] += kAgreementGain * (surprise - off_[slot]);
    if (off_[slot] <= kStraying) return false;
    off_[slot] = kMaxSurprise * 2;  // until it ends
    if (count(signature) < 2) signatures_[next_++ % signatures_.size()] = signature;
    return true;
  }
  [[nodiscard]] bool bars(std::size_t slot, std::uint8_t signature) const {
    return off_[slot] > kMaxSurprise || count(signature) >= 2;
  }

  /// For the digest.
  [[nodiscard]] float mean(std::size_t slot) const { return off_[slot]; }
  [[nodiscard]] std::span<const std::uint8_t> signatures() const { return signatures_; }

 private:
  [[nodiscard]] std::ptrdiff_t count(std::uint8_t signature) const {
    return std::count(signatures_.begin(), signatures_.end(), signature);
  }

  std::array<float, kLandmarks> off_{};
  std::array<std::uint8_t, 4> signatures_{};  ///< of the last ones; 0: none
  std::uint8_t next_ = 0;
};

}  // namespace fencepost::recon
