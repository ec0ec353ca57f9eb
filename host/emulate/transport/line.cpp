#include "host/emulate/transport/line.hpp"

#include <algorithm>

namespace fencepost::emulate {
namespace {

constexpr std::int64_t kNanosecondsPerTick = 1'000'000'000 / base::Time::kPerUnit;
constexpr std::int64_t kBitsAByte = 10;

std::int64_t ns(base::Time t) { return t.raw * kNanosecondsPerTick; }
std::int64_t ns(base::Duration d) { return d.raw * kNanosecondsPerTick; }

// Up: a byte is never there before its last bit.
base::Time tick_at(std::int64_t nanoseconds) { return {(nanoseconds + kNanosecondsPerTick - 1) / kNanosecondsPerTick}; }

std::int64_t byte_time(std::uint32_t baud) { return baud == 0 ? 0 : kBitsAByte * 1'000'000'000 / baud; }

}  // namespace

void Line::set_baud(std::uint32_t baud) { byte_ns_ = byte_time(baud); }

Line::Line(const LineSettings& settings)
    : settings_(settings),
      byte_ns_(byte_time(settings.baud)),
      out_(3 * settings.seed),
      in_(3 * settings.seed + 1),
      moods_(3 * settings.seed + 2) {}

void Line::say(std::span<const std::uint8_t> bytes, base::Time now) {
  if (bytes.empty()) return;
  ++counts_.said;
  std::int64_t start = std::max({ns(now), free_ns_, stalled_ns_});
  if (moods_.chance(settings_.faults.late)) {
    ++counts_.late;
    start += ns(settings_.faults.late_time);
  }
  for (std::size_t at = 0; at < bytes.size(); at += settings_.unit) {
    const auto unit = bytes.subspan(at, std::min(settings_.unit, bytes.size() - at));
    start += byte_ns_ * static_cast<std::int64_t>(unit.size());
    damage_unit(unit, start);
  }
  free_ns_ = start;
  if (moods_.chance(settings_.faults.stall)) {
    ++counts_.stalled;
    stalled_ns_ = start + ns(settings_.faults.stall_time);
  }
}

void Line::damage_unit(std::span<const std::uint8_t> unit, std::int64_t arrives_ns) {
  const auto first = damaged(unit.front(), settings_.faults, out_, counts_);
  if (!first || (unit.size() > 1 && *first != unit.front())) return;
  to_host_.push_back({arrives_ns, *first});
  for (const std::uint8_t byte : unit.subspan(1)) to_host_.push_back({arrives_ns, byte});
}

void Line::send(std::span<const std::uint8_t> bytes, base::Time now) {
  const std::int64_t arrives = std::max(ns(now), stalled_ns_);
  for (const std::uint8_t byte : bytes) {
    if (const auto kept = damaged(byte, settings_.faults, in_, counts_)) to_device_.push_back({arrives, *kept});
  }
}

Bytes Line::arrived(std::deque<Item>& queue, base::Time now) {
  Bytes bytes;
  while (!queue.empty() && queue.front().arrives_ns <= ns(now)) {
    bytes.push_back(queue.front().byte);
    queue.pop_front();
  }
  return bytes;
}

Bytes Line::to_host(base::Time now) { return arrived(to_host_, now); }
Bytes Line::to_device(base::Time now) { return arrived(to_device_, now); }

std::optional<base::Time> Line::next(const std::deque<Item>& queue) {
  if (queue.empty()) return std::nullopt;
  return tick_at(queue.front().arrives_ns);
}

void Line::clear() {
  to_host_.clear();
  to_device_.clear();
  free_ns_ = stalled_ns_ = 0;
}

}  // namespace fencepost::emulate
