#include "drivers/nxtcam/session.hpp"

#include <algorithm>
#include <utility>

#include "drivers/serial/largest_first.hpp"

namespace fencepost::nxtcam {
namespace {

using sensor::LinkState;

constexpr base::Duration kRetry = base::milliseconds(20);
constexpr base::Duration kSilentPause = base::milliseconds(100);
constexpr base::Duration kOtherSensorPause = base::milliseconds(500);
constexpr base::Duration kUntaughtPause = base::milliseconds(2'000);
// After this long without objects tracking is switched on again.
constexpr base::Duration kReassure = base::milliseconds(5'000);
// Failed transfers in a row after which the link is silent.
constexpr std::uint8_t kFailuresToSilence = 3;
constexpr std::size_t kFirstObjects = (kMaxRead - 1) / kObjectSize;  // of a read that begins with the count
constexpr std::size_t kMoreObjects = kMaxRead / kObjectSize;         // of the second read
constexpr std::size_t kRestObjects = kMaxObjects - kFirstObjects - kMoreObjects;

Transfer read(unsigned at, std::size_t count) {
  Transfer transfer;
  (void)transfer.out.push_back(static_cast<std::uint8_t>(at));
  transfer.expected = count;
  return transfer;
}

Transfer command(Command command) {
  Transfer transfer = read(kCommandRegister, 0);
  (void)transfer.out.push_back(static_cast<std::uint8_t>(command));
  return transfer;
}

}  // namespace

Transfer Session::transfer() const {
  constexpr unsigned kFirst = kCountRegister + 1U + kFirstObjects * kObjectSize;
  switch (step_) {
    case Step::kVersion: return read(kVersionRegister, 8);
    case Step::kProduct: return read(kVendorRegister, 16);
    case Step::kDisable: return command(Command::kDisableTracking);
    case Step::kFetchMap: return command(Command::kFetchColourMap);
    case Step::kMap1: return read(kColourMapRegister, 16);
    case Step::kMap2: return read(kColourMapRegister + 16U, 16);
    case Step::kMap3: return read(kColourMapRegister + 32U, 16);
    case Step::kSort: return command(Command::kSortBySize);
    case Step::kObjects: return command(Command::kObjectMode);
    case Step::kEnable: return command(Command::kEnableTracking);
    case Step::kLock: return command(Command::kLockBuffer);
    case Step::kCount: return read(kCountRegister, 1 + kFirstObjects * kObjectSize);
    case Step::kMore: return read(kFirst, kMoreObjects * kObjectSize);
    case Step::kRest: return read(kFirst + kMoreObjects * kObjectSize, kRestObjects * kObjectSize);
    case Step::kUnlock: break;
  }
  return command(Command::kUnlockBuffer);
}

std::optional<Transfer> Session::due(base::Time now) {
  if (next_ && now < *next_) return std::nullopt;
  if (step_ == Step::kCount || step_ == Step::kLock) started_ = now;
  // Again only after `take` or `fail`.
  next_ = base::Time{INT64_MAX};
  return transfer();
}

void Session::advance(Step step, base::Duration pause, base::Time t) {
  step_ = step;
  next_ = t + pause;
}

void Session::restart(base::Duration pause, base::Time t) {
  ++counters_.restarts;
  advance(Step::kVersion, pause, t);
}

void Session::fail(base::Error error, base::Time now) {
  ++counters_.refused;
  failures_ = static_cast<std::uint8_t>(std::min(failures_ + 1, int{kFailuresToSilence}));
  next_ = now + kRetry;
  const LinkState bad = error == base::Error::kGone ? LinkState::kAbsent : LinkState::kSilent;
  if (failures_ < kFailuresToSilence && bad == LinkState::kSilent) {
    // The remainder of a frame, read later, would belong to another one.
    if (step_ > Step::kCount) next_frame(now);
    return;
  }
  if (step_ != Step::kVersion) ++counters_.restarts;
  advance(Step::kVersion, kSilentPause, now);
  link_ = bad;
}

void Session::take(std::span<const std::uint8_t> bytes, base::Time t) {
  if (bytes.size() < transfer().expected) return fail(base::Error::kBadInput, t);
  failures_ = 0;
  link_ = std::max(link_, LinkState::kUnready);
  switch (step_) {
    case Step::kVersion: take_version(bytes); return advance(Step::kProduct, {}, t);
    case Step::kProduct:
      // Another sensor: it may be exchanged for the camera.
      if (!is_nxtcam(bytes)) return restart(kOtherSensorPause, t);
      wait_ = proven_ ? options_.again_wait : options_.command_wait;
      return advance(std::exchange(proven_, false) ? Step::kSort : Step::kDisable, {}, t);
    case Step::kDisable: return advance(options_.check_colour_map ? Step::kFetchMap : Step::kSort, wait_, t);
    case Step::kFetchMap: return advance(Step::kMap1, wait_, t);
    case Step::kMap1:
    case Step::kMap2:
    case Step::kMap3: return take_map(bytes, t);
    case Step::kSort: return advance(Step::kObjects, wait_, t);
    case Step::kObjects: return advance(Step::kEnable, wait_, t);
    case Step::kEnable: return take_enabled(t);
    case Step::kLock: return advance(Step::kCount, {}, t);
    case Step::kCount: return take_count(bytes, t);
    case Step::kMore:
    case Step::kRest: return take_objects(bytes, t);
    case Step::kUnlock: return next_frame(t);
  }
}

void Session::take_enabled(base::Time t) {
  const bool tracked_before = link_ > LinkState::kUnready;
  last_seen_ = t;
  next_frame(tracked_before ? t : t + wait_);
}

void Session::take_version(std::span<const std::uint8_t> bytes) {
  version_ = {};
  for (const std::uint8_t byte : bytes) {
    if (byte <= ' ' || byte > '~' || !version_.push_back(static_cast<char>(byte))) break;
  }
}

void Session::take_map(std::span<const std::uint8_t> bytes, base::Time t) {
  const std::size_t part = static_cast<std::size_t>(step_) - static_cast<std::size_t>(Step::kMap1);
  std::copy_n(bytes.begin(), 16, map_.begin() + static_cast<std::ptrdiff_t>(part * 16));
  if (step_ != Step::kMap3) return advance(static_cast<Step>(static_cast<int>(step_) + 1), {}, t);
  if (taught_colours(map_) != 0) return advance(Step::kSort, {}, t);
  link_ = LinkState::kUnready;
  restart(kUntaughtPause, t);
}

// The count honoured, whatever older objects lie behind it.
void Session::take_count(std::span<const std::uint8_t> bytes, base::Time t) {
  if (bytes[0] > kMaxObjects) return reject(t);
  expected_ = bytes[0];
  building_ = {};
  fresh_ = false;
  building_.t = t;
  take_objects(bytes.subspan(1), t);
}

void Session::take_objects(std::span<const std::uint8_t> bytes, base::Time t) {
  for (; bytes.size() >= kObjectSize && building_.blobs.size() < expected_; bytes = bytes.subspan(kObjectSize)) {
    const std::optional<sensor::Blob> blob = object_in(bytes.first(kObjectSize));
    if (!blob) return reject(t);
    (void)serial::insert_largest_first(building_, *blob);
  }
  if (building_.blobs.size() == expected_) return finish_frame(t);
  advance(step_ == Step::kCount ? Step::kMore : Step::kRest, {}, t);
}

void Session::finish_frame(base::Time t) {
  building_.frame = counters_.frames++;
  fresh_ = true;
  link_ = building_.blobs.empty() ? LinkState::kEmpty : LinkState::kOk;
  if (!building_.blobs.empty()) {
    last_seen_ = t;
    proven_ = true;
  }
  if (options_.lock_buffer) return advance(Step::kUnlock, {}, t);
  next_frame(t);
}

void Session::next_frame(base::Time t) {
  if (t - last_seen_ > kReassure) return advance(Step::kEnable, {}, t);
  step_ = options_.lock_buffer ? Step::kLock : Step::kCount;
  next_ = std::max(started_ + options_.period, t);
}

void Session::reject(base::Time t) {
  ++counters_.rejected;
  if (options_.lock_buffer) return advance(Step::kUnlock, {}, t);
  next_frame(t);
}

}  // namespace fencepost::nxtcam
