#include "host/emulate/scene/endpoint.hpp"

#include <algorithm>
#include <cstdio>

namespace fencepost::emulate {
namespace {

LineSettings line_of(const EndpointSettings& settings) {
  return {settings.device.baud, settings.device.unit, settings.faults, settings.seed};
}

std::optional<base::Time> earliest(std::initializer_list<std::optional<base::Time>> times) {
  std::optional<base::Time> first;
  for (const std::optional<base::Time>& time : times) {
    if (time) first = first ? std::min(*first, *time) : *time;
  }
  return first;
}

}  // namespace

Endpoint::Endpoint(EndpointSettings settings, const Feed& feed, base::Time now)
    : settings_(std::move(settings)), line_(line_of(settings_)), baud_(settings_.device.baud) {
  const EmulatedDevice& device = settings_.device;
  model_ = device.make([&feed](std::uint8_t signature) { return feed.colour_of(signature); });
  if (device.image) {
    fit_.emplace(feed.camera, *device.image);
    frame_period_ = base::Duration::nearest(1 / device.image->max_rate);
  }
  (void)model_->power_up(now);
  if (!feed.poses.empty()) (void)model_->pose(feed.poses.front(), now);
}

void Endpoint::connect(bool connected, base::Time now) {
  if (connected == connected_) return;
  connected_ = connected;
  (void)line_.to_device(now);
  line_.clear();
}

// A device changes its rate when its answer is out.
Bytes Endpoint::to_host(base::Time now) {
  const std::uint32_t own = settings_.device.baud;
  const std::uint32_t wanted = own == 0 || model_->baud() == 0 ? own : model_->baud();
  if (wanted != baud_ && line_.idle()) line_.set_baud(baud_ = wanted);
  return line_.to_host(now);
}

bool Endpoint::in_use() const { return connected_ && model_->in_use(); }

void Endpoint::hear(std::span<const std::uint8_t> bytes, const Travel& travel, base::Time now) {
  model_->roll(travel);
  counts_.commands += bytes.size();
  trace(true, bytes, now);
  line_.send(bytes, now);
  take_arrived(now);
}

void Endpoint::take_arrived(base::Time now) {
  for (const std::uint8_t byte : line_.to_device(now)) say(model_->take(byte, now), now);
}

// A camera that is asked has the newest image; one that writes to its line by itself takes the next when that is done.
void Endpoint::see(const sensor::BlobFrame& frame, base::Time now) {
  if (!fit_) return;
  if ((next_frame_ && now < *next_frame_) || (!settings_.device.asked && !line_.idle())) {
    ++counts_.skipped;
    return;
  }
  next_frame_ = now + frame_period_;
  ++counts_.frames;
  say(model_->see(fit_->fit(frame), now), now);
}

void Endpoint::pose(const sensor::OdometrySample& sample, base::Time now) { say(model_->pose(sample, now), now); }

void Endpoint::step(const Travel& travel, base::Time now) {
  model_->roll(travel);
  reboot_if_due(now);
  unplug_if_due(now);
  take_arrived(now);
  // Bounded: after a long suspension of the machine not all of it is caught up.
  for (int i = 0; i < 1'000 && model_->next() && *model_->next() <= now; ++i) {
    const base::Time due = *model_->next();
    say(model_->step(due), due);
  }
}

void Endpoint::reboot_if_due(base::Time now) {
  if (!next_reboot_ || now < *next_reboot_) return;
  next_reboot_ = *next_reboot_ + settings_.faults.reboot;
  ++line_.counts().reboots;
  line_.clear();
  if (settings_.trace) settings_.trace(settings_.name + ": switched off and on");
  say(model_->power_up(now), now);
}

void Endpoint::unplug_if_due(base::Time now) {
  if (!next_plug_ || now < *next_plug_) return;
  unplugged_ = !unplugged_;
  next_plug_ = *next_plug_ + (unplugged_ ? settings_.faults.unplug_time : settings_.faults.unplug);
  line_.counts().unplugs += unplugged_ ? 1U : 0U;
  line_.clear();
}

std::optional<base::Time> Endpoint::next_step() const {
  return earliest({model_->next(), line_.next_to_device(), next_reboot_, next_plug_});
}

void Endpoint::begin(base::Time now) {
  if (settings_.faults.reboot.raw > 0) next_reboot_ = now + settings_.faults.reboot;
  if (settings_.faults.unplug.raw > 0) next_plug_ = now + settings_.faults.unplug;
}

void Endpoint::say(const Bytes& bytes, base::Time now) {
  if (bytes.empty() || !connected_ || unplugged_) return;
  ++counts_.replies;
  trace(false, bytes, now);
  line_.say(bytes, now);
}

void Endpoint::trace(bool from_host, std::span<const std::uint8_t> bytes, base::Time now) const {
  if (!settings_.trace) return;
  char time[32] = {};
  (void)std::snprintf(time, sizeof time, "%9.4f ", now.to_double());
  const std::string message = bytes.empty() ? std::string() : settings_.device.describe(from_host, bytes);
  settings_.trace(time + settings_.name + (from_host ? " < " : " > ") + hex_of(bytes) +
                  (message.empty() ? "" : "  " + message));
}

}  // namespace fencepost::emulate
