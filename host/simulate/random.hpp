// Our own random numbers: the standard library's distributions differ between implementations.
#pragma once

#include <cstdint>

namespace fencepost::host {

/// The purpose of a draw. Each purpose and index has its own stream, so enabling or disabling one noise, or dropping a
/// frame, leaves all other draws unchanged.
enum class Purpose : std::uint64_t {
  kDetection = 1,
  kFalseBlobs = 2,
  kViewPose = 3,
  kDrift = 4,
  kLatency = 5,
  kDrop = 6,
  kCarReading = 7
};

/// xoshiro256** seeded by splitmix64 (Blackman, Vigna).
class Random {
 public:
  Random(std::uint64_t seed, Purpose purpose, std::uint64_t index);

  std::uint64_t next();
  /// In [0, 1), 53 bits.
  double uniform();
  double uniform(double low, double high);
  /// True with that probability; always draws once.
  bool chance(double probability);
  /// 0..count-1; `count` > 0.
  std::uint64_t below(std::uint64_t count);
  /// Zero mean, unit variance (Marsaglia's polar method).
  double gaussian();
  /// Knuth's product method; meant for means up to about 100.
  unsigned poisson(double mean);

 private:
  std::uint64_t state_[4];
  double spare_ = 0;
  bool has_spare_ = false;
};

}  // namespace fencepost::host
