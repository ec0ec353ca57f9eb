// A feed and the devices that play it, on one clock that the caller steps.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "host/emulate/scene/endpoint.hpp"
#include "host/emulate/scene/feed.hpp"

namespace fencepost::emulate {

struct PlaybackSettings {
  double speed = 1;                       ///< of the feed; the devices themselves stay as fast as they are
  std::optional<base::Duration> delay;    ///< maximum time from the start until time begins
  bool loop = false;                      ///< the feed from the front again; wheels go on from where they are
  std::optional<base::Duration> seconds;  ///< length, from the beginning of time
};

/// Time begins once at least one device has been in use, and none connected but not in use, for kSettle. Until then the
/// feed holds its first moment and the wheels stand, so a camera's slow start misses nothing. Devices on CAN, where no
/// host is seen, do not begin it. It ends a second (kHold) after the feed's last record.
class Playback {
 public:
  static constexpr base::Duration kHold = base::milliseconds(1'000);
  /// A host opens its devices one after the other.
  static constexpr base::Duration kSettle = base::milliseconds(100);

  Playback(Feed feed, const PlaybackSettings& settings, base::Time now);
  Playback(const Playback&) = delete;
  Playback& operator=(const Playback&) = delete;

  /// Before the first `advance`.
  Endpoint& add(EndpointSettings settings);
  [[nodiscard]] std::size_t size() const { return endpoints_.size(); }
  Endpoint& endpoint(std::size_t index) { return *endpoints_.at(index); }
  [[nodiscard]] const Feed& feed() const { return feed_; }
  [[nodiscard]] const TravelLog& travel() const { return travel_; }

  /// The host's bytes for a device.
  void hear(std::size_t index, std::span<const std::uint8_t> bytes, base::Time now);
  /// Does everything that is due by `now`, each at its own time. Rare calls delay only the reading.
  void advance(base::Time now);
  /// When `advance` has something to do next.
  [[nodiscard]] std::optional<base::Time> next() const;

  [[nodiscard]] std::optional<base::Time> begun() const { return begun_; }
  [[nodiscard]] bool over(base::Time now) const;
  [[nodiscard]] std::uint64_t rounds() const { return rounds_; }

 private:
  void begin_if_ready(base::Time now);
  void rewind();
  void dispatch(base::Time now);
  [[nodiscard]] base::Time when(base::Time of_feed) const;
  [[nodiscard]] std::optional<base::Time> next_record() const;
  [[nodiscard]] std::optional<base::Time> next_step() const;
  [[nodiscard]] Travel travel_at(base::Time now) const;

  Feed feed_;
  TravelLog travel_;
  PlaybackSettings settings_;
  base::Time started_;
  std::vector<std::unique_ptr<Endpoint>> endpoints_;
  std::optional<base::Time> ready_since_;
  std::optional<base::Time> begun_;
  base::Time round_begun_;
  std::uint64_t rounds_ = 0;
  std::size_t frame_ = 0;
  std::size_t pose_ = 0;
};

}  // namespace fencepost::emulate
