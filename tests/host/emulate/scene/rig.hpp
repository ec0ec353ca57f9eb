// Drivers, a playback and a clock that the test moves.
#pragma once

#include <algorithm>
#include <string>

#include "hal/bus/byte_link.hpp"
#include "hal/fake/stepped_clock.hpp"
#include "host/devices/emulated.hpp"
#include "host/emulate/scene/playback.hpp"

namespace fencepost::emulate {

/// A driver's end of a endpoint's line.
class EndpointLink {
 public:
  EndpointLink(Playback& playback, std::size_t index, const fake::SteppedClock& clock)
      : playback_(playback), index_(index), clock_(clock) {}

  base::Result<std::size_t> read(std::span<std::uint8_t> in) {
    Endpoint& endpoint = playback_.endpoint(index_);
    if (endpoint.unplugged()) return base::Error::kGone;
    const Bytes fresh = endpoint.to_host(clock_.now());
    waiting_.insert(waiting_.end(), fresh.begin(), fresh.end());
    if (waiting_.empty()) return base::Error::kNotReady;
    const std::size_t count = std::min(in.size(), waiting_.size());
    std::copy_n(waiting_.begin(), count, in.begin());
    waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(count));
    return count;
  }
  base::Result<std::size_t> write(std::span<const std::uint8_t> out) {
    if (playback_.endpoint(index_).unplugged()) return base::Error::kGone;
    playback_.hear(index_, out, clock_.now());
    return out.size();
  }

 private:
  Playback& playback_;
  std::size_t index_;
  const fake::SteppedClock& clock_;
  Bytes waiting_;
};
static_assert(bus::ByteLink<EndpointLink>);

inline EmulatedDevice emulated_device(const std::string& name) {
  return devices::emulated(*devices::parse_device(name, devices::Use::kEmulated));
}

struct Rig {
  static constexpr base::Duration kStep = base::milliseconds(1);

  Rig(const Feed& feed, const PlaybackSettings& settings = {}) : playback(feed, settings, clock.now()) {}

  /// Connected from the start.
  EndpointLink add(const std::string& device, const FaultSettings& faults = {}, std::uint64_t seed = 1) {
    Endpoint& endpoint = playback.add({device, emulated_device(device), faults, seed, {}});
    endpoint.connect(true, clock.now());
    return {playback, playback.size() - 1, clock};
  }
  void step() {
    clock.advance(kStep);
    playback.advance(clock.now());
  }
  /// Seconds since time began.
  [[nodiscard]] double since_begin() const { return base::Duration(clock.now() - *playback.begun()).to_double(); }

  fake::SteppedClock clock;
  Playback playback;
};

inline sensor::Blob box(std::uint8_t signature, int x1, int y1, int x2, int y2) {
  return {signature,
          static_cast<std::int16_t>(x1),
          static_cast<std::int16_t>(y1),
          static_cast<std::int16_t>(x2),
          static_cast<std::int16_t>(y2),
          {5 * (x1 + x2)},
          {5 * (y1 + y2)},
          0,
          {}};
}

/// Ten frames a second from t = 0.1 s, one red box of signature 1 in each, all different; the robot drives 0.2 m/s.
inline Feed moving_box(std::uint16_t width, std::uint16_t height, int frames) {
  Feed feed;
  feed.camera.emplace();
  feed.camera->width = width;
  feed.camera->height = height;
  feed.signatures.push_back({1, {200, 32, 32}, "red"});
  for (int i = 0; i < frames; ++i) {
    sensor::BlobFrame frame{base::Time{1'000 * (i + 1)}, static_cast<std::uint32_t>(i), {}};
    (void)frame.blobs.push_back(box(1, 2 + i % 40, 3 + i / 2 % 40, 20 + i % 40 + i % 3, 30 + i / 2 % 40));
    feed.frames.push_back(frame);
  }
  for (int i = 0; i <= 5 * frames; ++i) feed.poses.push_back({base::Time{200 * i}, {40 * i}, {}, {}});
  return feed;
}

}  // namespace fencepost::emulate
