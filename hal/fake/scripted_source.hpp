// A camera and an odometry source that play a script by the test's clock.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/base/result.hpp"
#include "hal/base/units.hpp"
#include "hal/sensor/sources.hpp"

namespace fencepost::fake {

/// The one answer of a poll at or after `at`, and the link's state from then on.
template <class Sample>
struct SourceStep {
  base::Time at;
  base::Result<Sample> answer = base::Error::kNotReady;
  sensor::LinkState link = sensor::LinkState::kOk;
  std::uint32_t dropped = 0;  ///< added to the count of dropped blobs
};

template <class Sample>
class ScriptedSource {
 public:
  /// The script is borrowed, its times do not decrease.
  constexpr explicit ScriptedSource(std::span<const SourceStep<Sample>> script) : script_(script) {}

  constexpr base::Result<Sample> poll(base::Time now) {
    if (next_ == script_.size() || now < script_[next_].at) return base::Error::kNotReady;
    const SourceStep<Sample>& step = script_[next_++];
    link_ = step.link;
    dropped_ += step.dropped;
    return step.answer;
  }
  [[nodiscard]] constexpr sensor::LinkState link() const { return link_; }
  [[nodiscard]] constexpr std::uint32_t dropped() const { return dropped_; }
  /// A script that ends says nothing of a device that fell silent.
  [[nodiscard]] static constexpr bool stamped_here() { return false; }
  [[nodiscard]] constexpr bool finished() const { return next_ == script_.size(); }

 private:
  std::span<const SourceStep<Sample>> script_;
  std::size_t next_ = 0;
  sensor::LinkState link_ = sensor::LinkState::kSilent;
  std::uint32_t dropped_ = 0;
};

using CameraStep = SourceStep<sensor::BlobFrame>;
using ScriptedCamera = ScriptedSource<sensor::BlobFrame>;
static_assert(sensor::BlobCamera<ScriptedCamera>);

using OdometryStep = SourceStep<sensor::OdometrySample>;
using ScriptedOdometry = ScriptedSource<sensor::OdometrySample>;
static_assert(sensor::OdometrySource<ScriptedOdometry>);

}  // namespace fencepost::fake
