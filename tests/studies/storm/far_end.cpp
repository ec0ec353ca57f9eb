#include "tests/studies/storm/far_end.hpp"

#include <algorithm>

namespace fencepost::test {

FarEnd::FarEnd(const emulate::EmulatedDevice& device, const emulate::Colours& colours,
               const std::optional<sensor::CameraIntrinsics>& of_boxes, std::uint64_t seed, base::Time now)
    : device_(device), model_(device.make(colours)), chance_(seed), now_(now) {
  constexpr std::int64_t kBitsOfAByte = 10;
  if (device_.baud > 0) byte_ns_ = kBitsOfAByte * 1'000'000'000 / device_.baud;
  if (device_.image) {
    fit_.emplace(of_boxes, *device_.image);
    frame_period_ = base::Duration::nearest(1 / device_.image->max_rate);
  }
  on_wires_ = dynamic_cast<emulate::I2cDevice*>(model_.get());
  (void)model_->power_up(now);
}

// As host/emulate/scene has it: one that is asked has the newest image, the others take one when their line is free.
void FarEnd::see(const sensor::BlobFrame& frame, base::Time now) {
  if (!fit_ || !powered_) return;
  if (!frozen_) latest_ = fit_->fit(frame);
  if ((next_frame_ && now < *next_frame_) || (!device_.asked && !to_robot_.empty())) return;
  next_frame_ = now + frame_period_;
  say(model_->see(latest_, now), now);
}

void FarEnd::pose(const sensor::OdometrySample& sample, base::Time now) {
  if (powered_) say(model_->pose(sample, now), now);
}

void FarEnd::step(const emulate::Travel& travel, base::Time now) {
  now_ = now;
  model_->roll(travel);
  if (!powered_) return;
  while (!stalled_ && !to_device_.empty() && to_device_.front().arrives <= now_ns()) {
    const std::uint8_t byte = to_device_.front().byte;
    to_device_.pop_front();
    say(model_->take(byte, now), now);
  }
  while (const std::optional<base::Time> due = model_->next()) {
    if (*due > now) break;
    say(model_->step(*due), *due);
  }
}

void FarEnd::set_plugged(bool plugged) {
  if (plugged && !plugged_ && lives_on_cable_) static_cast<void>(model_->power_up(now_));
  plugged_ = plugged;
  to_robot_.clear();
  to_device_.clear();
}

void FarEnd::set_power(bool on, base::Time now) {
  powered_ = on;
  to_robot_.clear();
  to_device_.clear();
  if (on) say(model_->power_up(now), now);
}

void FarEnd::inject(std::uint64_t count, std::uint64_t seed) {
  Chance bytes(seed);
  count = (count + device_.unit - 1) / device_.unit * device_.unit;
  if (!plugged_ || to_robot_.size() + count > kPortBuffer) return;
  for (; count > 0; --count) to_robot_.push_back({now_ns(), static_cast<std::uint8_t>(bytes.whole(0, 255))});
}

std::size_t FarEnd::read(std::span<std::uint8_t> in) {
  std::size_t count = 0;
  while (!stalled_ && count < in.size() && !to_robot_.empty() && to_robot_.front().arrives <= now_ns()) {
    in[count++] = to_robot_.front().byte;
    to_robot_.pop_front();
  }
  return count;
}

// Where several bytes are one, any that is damaged loses all.
void FarEnd::write(std::span<const std::uint8_t> out) {
  if (device_.unit > 1 && noise_ > 0 && chance_.share(noise_ * static_cast<double>(out.size()))) return;
  std::int64_t at = to_device_.empty() ? now_ns() : std::max(now_ns(), to_device_.back().arrives);
  for (std::uint8_t byte : out) {
    at += byte_ns_;
    if (device_.unit > 1 || !damages(byte)) to_device_.push_back({at, byte});
  }
}

Transferred FarEnd::transfer(std::uint8_t address, std::span<const std::uint8_t> out, std::size_t expected) {
  Transferred result;
  if (on_wires_ == nullptr || !powered_) return result;
  constexpr std::int64_t kLongestStretch = 150;  // ms
  if (noise_ > 0 && chance_.share(noise_)) result.stretched = base::milliseconds(chance_.whole(1, kLongestStretch));
  emulate::Bytes heard;
  for (std::uint8_t byte : out) {
    if (damages(byte)) return result;
    heard.push_back(byte);
  }
  result.in = on_wires_->transfer(address, heard, expected, now_);
  if (!result.in) return result;
  for (std::size_t i = 0; i < result.in->size(); ++i) {
    std::uint8_t& byte = (*result.in)[i];
    if (!to_robot_.empty()) {
      byte = to_robot_.front().byte;  // hostile
      to_robot_.pop_front();
    }
    if (damages(byte)) result.in->resize(i);
  }
  return result;
}

void FarEnd::say(const emulate::Bytes& bytes, base::Time now) {
  if (bytes.empty() || !plugged_) return;
  free_ns_ = std::max(free_ns_, now.raw * 100'000);
  for (std::span<const std::uint8_t> rest(bytes); !rest.empty();) {
    const std::size_t size = std::min(rest.size(), device_.unit);
    say_unit(rest.first(size));
    rest = rest.subspan(size);
  }
}

// A unit of several bytes has a checksum of its own: its receiver throws it away when any of it is damaged.
void FarEnd::say_unit(std::span<const std::uint8_t> unit) {
  emulate::Bytes heard;
  bool whole = true;
  for (std::uint8_t byte : unit) {
    const std::uint8_t said = byte;
    const bool lost = damages(byte);
    whole = whole && !lost && byte == said;
    free_ns_ += byte_ns_;
    if (!lost) heard.push_back(byte);
  }
  if ((unit.size() > 1 && !whole) || to_robot_.size() + unit.size() > kPortBuffer) return;
  for (const std::uint8_t byte : heard) to_robot_.push_back({free_ns_, byte});
}

// True: it is lost.
bool FarEnd::damages(std::uint8_t& byte) {
  if (noise_ <= 0 || !chance_.share(noise_)) return false;
  if (chance_.one_in(2)) return true;
  byte = static_cast<std::uint8_t>(byte ^ chance_.whole(1, 255));
  return false;
}

}  // namespace fencepost::test
