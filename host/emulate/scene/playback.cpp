#include "host/emulate/scene/playback.hpp"

#include <algorithm>

namespace fencepost::emulate {

Playback::Playback(Feed feed, const PlaybackSettings& settings, base::Time now)
    : feed_(std::move(feed)), travel_(feed_.poses), settings_(settings), started_(now) {}

Endpoint& Playback::add(EndpointSettings settings) {
  endpoints_.push_back(std::make_unique<Endpoint>(std::move(settings), feed_, started_));
  return *endpoints_.back();
}

base::Time Playback::when(base::Time of_feed) const {
  const base::Duration passed = of_feed - feed_.begin();
  return round_begun_ + base::Duration::nearest(passed.to_double() / settings_.speed);
}

Travel Playback::travel_at(base::Time now) const {
  if (!begun_) return {};
  const base::Duration passed = now - round_begun_;
  Travel travel = travel_.at(feed_.begin() + base::Duration::nearest(passed.to_double() * settings_.speed));
  const Travel round = travel_.at(feed_.end());
  travel.distance += static_cast<double>(rounds_) * round.distance;
  travel.heading += static_cast<double>(rounds_) * round.heading;
  travel.speed *= settings_.speed;
  travel.turn_rate *= settings_.speed;
  return travel;
}

void Playback::hear(std::size_t index, std::span<const std::uint8_t> bytes, base::Time now) {
  endpoints_.at(index)->hear(bytes, travel_at(now), now);
}

void Playback::begin_if_ready(base::Time now) {
  if (begun_) return;
  // On CAN a host cannot be seen.
  const auto seen = [](const auto& endpoint) { return endpoint->device().host_seen; };
  const auto in_use = [&](const auto& endpoint) { return seen(endpoint) && endpoint->in_use(); };
  const auto idle = [](const auto& endpoint) { return endpoint->connected() && !endpoint->in_use(); };
  const bool ready = std::any_of(endpoints_.begin(), endpoints_.end(), in_use) &&
                     std::none_of(endpoints_.begin(), endpoints_.end(), idle);
  if (!ready) ready_since_.reset();
  if (ready && !ready_since_) ready_since_ = now;
  const bool late = settings_.delay && now - started_ >= *settings_.delay;
  if (!late && !(ready_since_ && now - *ready_since_ >= kSettle)) return;
  begun_ = round_begun_ = now;
  for (const auto& endpoint : endpoints_) endpoint->begin(now);
}

void Playback::rewind() {
  const base::Time end = when(feed_.end());
  // One sample's time between the last record and the first one again.
  constexpr base::Duration kPause = base::milliseconds(20);
  round_begun_ = end + kPause;
  ++rounds_;
  frame_ = pose_ = 0;
}

std::optional<base::Time> Playback::next_record() const {
  std::optional<base::Time> first;
  if (pose_ < feed_.poses.size()) first = when(feed_.poses[pose_].t);
  if (frame_ < feed_.frames.size()) {
    const base::Time frame = when(feed_.frames[frame_].t);
    first = first ? std::min(*first, frame) : frame;
  }
  return first;
}

// At equal times the pose comes first: a frame that arrives together with its pose follows it.
void Playback::dispatch(base::Time now) {
  if (pose_ < feed_.poses.size() && when(feed_.poses[pose_].t) <= now) {
    for (const auto& endpoint : endpoints_) endpoint->pose(feed_.poses[pose_], now);
    ++pose_;
    return;
  }
  for (const auto& endpoint : endpoints_) endpoint->see(feed_.frames[frame_], now);
  ++frame_;
}

std::optional<base::Time> Playback::next_step() const {
  std::optional<base::Time> first;
  for (const auto& endpoint : endpoints_) {
    if (const auto time = endpoint->next_step()) first = first ? std::min(*first, *time) : *time;
  }
  return first;
}

std::optional<base::Time> Playback::next() const {
  std::optional<base::Time> first = next_step();
  const auto also = [&first](const std::optional<base::Time>& time) {
    if (time) first = first ? std::min(*first, *time) : *time;
  };
  if (begun_) also(next_record());
  for (const auto& endpoint : endpoints_) also(endpoint->next_to_host());
  return first;
}

void Playback::advance(base::Time now) {
  begin_if_ready(now);
  for (;;) {
    if (begun_ && settings_.loop && !next_record()) rewind();
    const std::optional<base::Time> record = begun_ ? next_record() : std::nullopt;
    const std::optional<base::Time> step = next_step();
    if (record && *record <= now && (!step || *record <= *step)) {
      dispatch(*record);
    } else if (step && *step <= now) {
      for (const auto& endpoint : endpoints_) endpoint->step(travel_at(*step), *step);
    } else {
      return;
    }
  }
}

bool Playback::over(base::Time now) const {
  if (!begun_) return false;
  if (settings_.seconds && now - *begun_ >= *settings_.seconds) return true;
  return !settings_.loop && !next_record() && now - when(feed_.end()) >= kHold;
}

}  // namespace fencepost::emulate
