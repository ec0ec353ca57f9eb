#include "host/emulate/scene/station.hpp"

#include <linux/can.h>

#include <algorithm>
#include <cstdio>

#include "host/emulate/transport/words.hpp"

namespace fencepost::emulate {
namespace {

LineSettings line_of(const StationSettings& settings) {
  const bool can = settings.device.kind->speech == Speech::kCan;
  return {settings.device.baud, can ? sizeof(can_frame) : 1, settings.faults, settings.seed};
}

bool is_camera(const DeviceSpec& device) {
  return device.kind->image && (device.kind->speech != Speech::kNxt || device.camera_port);
}

std::optional<base::Time> earliest(std::initializer_list<std::optional<base::Time>> times) {
  std::optional<base::Time> first;
  for (const std::optional<base::Time>& time : times) {
    if (time) first = first ? std::min(*first, *time) : *time;
  }
  return first;
}

}  // namespace

Station::Station(StationSettings settings, const Feed& feed, base::Time now)
    : settings_(std::move(settings)), line_(line_of(settings_)) {
  const DeviceKind& kind = *settings_.device.kind;
  peer_ = kind.make(settings_.device, [&feed](std::uint8_t signature) { return feed.colour_of(signature); });
  if (is_camera(settings_.device)) {
    fit_.emplace(feed.camera, *kind.image);
    frame_period_ = base::Duration::nearest(1 / kind.image->max_rate);
  }
  (void)peer_->power_up(now);
  if (!feed.poses.empty()) (void)peer_->pose(feed.poses.front(), now);
}

void Station::connect(bool connected, base::Time now) {
  if (connected == connected_) return;
  connected_ = connected;
  (void)line_.to_device(now);
  line_.clear();
}

bool Station::in_use() const { return connected_ && peer_->in_use(); }

void Station::hear(std::span<const std::uint8_t> bytes, const Travel& travel, base::Time now) {
  peer_->roll(travel);
  counts_.commands += bytes.size();
  trace(true, bytes, now);
  line_.send(bytes, now);
  take_arrived(now);
}

void Station::take_arrived(base::Time now) {
  for (const std::uint8_t byte : line_.to_device(now)) say(peer_->take(byte, now), now);
}

// A camera that is asked has the newest image; one that writes to its line by itself takes the next when that is done.
void Station::see(const sensor::BlobFrame& frame, base::Time now) {
  if (!fit_) return;
  const bool polled = settings_.device.kind->speech == Speech::kPixy2 || settings_.device.kind->speech == Speech::kNxt;
  if ((next_frame_ && now < *next_frame_) || (!polled && !line_.idle())) {
    ++counts_.skipped;
    return;
  }
  next_frame_ = now + frame_period_;
  ++counts_.frames;
  say(peer_->see(fit_->fit(frame), now), now);
}

void Station::pose(const sensor::OdometrySample& sample, base::Time now) { say(peer_->pose(sample, now), now); }

void Station::step(const Travel& travel, base::Time now) {
  peer_->roll(travel);
  reboot_if_due(now);
  unplug_if_due(now);
  take_arrived(now);
  // Bounded: after a long sleep of the machine not all of it is made up.
  for (int i = 0; i < 1'000 && peer_->next() && *peer_->next() <= now; ++i) {
    const base::Time due = *peer_->next();
    say(peer_->step(due), due);
  }
}

void Station::reboot_if_due(base::Time now) {
  if (!next_reboot_ || now < *next_reboot_) return;
  next_reboot_ = *next_reboot_ + settings_.faults.reboot;
  ++line_.counts().reboots;
  line_.clear();
  if (settings_.trace) settings_.trace(settings_.name + ": switched off and on");
  say(peer_->power_up(now), now);
}

void Station::unplug_if_due(base::Time now) {
  if (!next_plug_ || now < *next_plug_) return;
  unplugged_ = !unplugged_;
  next_plug_ = *next_plug_ + (unplugged_ ? settings_.faults.unplug_time : settings_.faults.unplug);
  line_.counts().unplugs += unplugged_ ? 1U : 0U;
  line_.clear();
}

std::optional<base::Time> Station::next_step() const {
  return earliest({peer_->next(), line_.next_to_device(), next_reboot_, next_plug_});
}

void Station::begin(base::Time now) {
  if (settings_.faults.reboot.raw > 0) next_reboot_ = now + settings_.faults.reboot;
  if (settings_.faults.unplug.raw > 0) next_plug_ = now + settings_.faults.unplug;
}

void Station::say(const Bytes& bytes, base::Time now) {
  if (bytes.empty() || !connected_ || unplugged_) return;
  ++counts_.replies;
  trace(false, bytes, now);
  line_.say(bytes, now);
}

void Station::trace(bool from_host, std::span<const std::uint8_t> bytes, base::Time now) const {
  if (!settings_.trace) return;
  char time[32] = {};
  (void)std::snprintf(time, sizeof time, "%9.4f ", now.to_double());
  const std::string words = words_of(settings_.device.kind->speech, from_host, bytes);
  settings_.trace(time + settings_.name + (from_host ? " < " : " > ") + hex_of(bytes) +
                  (words.empty() ? "" : "  " + words));
}

}  // namespace fencepost::emulate
