// Moves bytes between a link and a device's session. All knowledge of the device is in the session.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/base/result.hpp"
#include "hal/base/units.hpp"
#include "hal/bus/byte_link.hpp"
#include "hal/sensor/link_state.hpp"

namespace fencepost::serial {

/// The protocol state machine of one device, without a link: bytes in, samples and bytes out. Nothing blocks.
/// `take` eats one byte that arrived at `now`; true: a sample is complete, `sample()` is it until the next byte.
/// `step` lets time pass, before bytes are sent. `link_lost`: the plug was pulled; the next step restarts the session.
template <class T>
concept Session = requires(T session, const T& same, std::uint8_t byte, base::Time now) {
  typename T::Sample;
  { session.take(byte, now) } -> std::same_as<bool>;
  { same.sample() } -> std::convertible_to<const typename T::Sample&>;
  { session.step(now) } -> std::same_as<void>;
  { session.link_lost() } -> std::same_as<void>;
  { session.outbox().waiting() } -> std::same_as<std::span<const std::uint8_t>>;
  { same.link() } -> std::same_as<sensor::LinkState>;
};

/// A link and nothing more, to assert concepts with.
struct LinkArchetype {
  static base::Result<std::size_t> read(std::span<std::uint8_t> /*in*/) { return base::Error::kGone; }
  static base::Result<std::size_t> write(std::span<const std::uint8_t> /*out*/) { return base::Error::kGone; }
};
static_assert(bus::ByteLink<LinkArchetype>);

template <bus::ByteLink Link, Session Conversation>
class Pump {
 public:
  using Sample = typename Conversation::Sample;

  /// The link is borrowed.
  explicit Pump(Link& link) : link_(link) {}
  template <class Config>
  Pump(Link& link, const Config& config) : link_(link), session_(config) {}

  /// The next sample, in order of time, or kNotReady. At most kBytesAPoll bytes are looked at, none is waited for.
  /// A sample with the same arrival time as the one before was delayed on the way, and is dropped.
  base::Result<Sample> poll(base::Time now) {
    const bool complete = read(now);
    session_.step(now);
    write();
    if (!complete) return base::Error::kNotReady;
    return latest_;
  }

  /// Sends what the session has to say by now, without waiting for the next poll.
  void push(base::Time now) {
    session_.step(now);
    write();
  }

  [[nodiscard]] sensor::LinkState link() const { return absent_ ? sensor::LinkState::kAbsent : session_.link(); }
  [[nodiscard]] std::uint32_t dropped() const requires requires(const Conversation& session) { session.dropped(); }
  { return session_.dropped(); }
  /// Samples dropped because they arrived bunched with an earlier one.
  [[nodiscard]] std::uint32_t stale() const { return stale_; }
  /// Reads that failed for another reason than an unplugged link: parity, framing, overrun.
  [[nodiscard]] std::uint32_t faults() const { return faults_; }
  [[nodiscard]] const Conversation& session() const { return session_; }
  [[nodiscard]] Conversation& session() { return session_; }

 private:
  static constexpr std::size_t kChunk = 64;
  static constexpr std::size_t kBytesAPoll = 512;  ///< 44 ms of 115200 Bd: more than a loop may sleep

  // True once a sample is complete; the bytes after it wait for the next poll.
  bool read(base::Time now) {
    for (std::size_t chunks = 0; chunks < kBytesAPoll / kChunk; ++chunks) {
      if (at_ == size_ && !refill(now)) return false;
      while (at_ < size_) {
        if (session_.take(buffer_[at_++], arrived_) && keep()) return true;
      }
    }
    return false;
  }

  bool refill(base::Time now) {
    at_ = size_ = 0;
    const base::Result<std::size_t> got = link_.read(buffer_);
    if (!got) {
      note_failure(got.error());
      return false;
    }
    absent_ = false;
    size_ = *got;
    arrived_ = now;
    return size_ > 0;
  }

  bool keep() {
    const Sample& sample = session_.sample();
    if (any_ && sample.t <= latest_.t) {
      ++stale_;
      return false;
    }
    any_ = true;
    latest_ = sample;
    return true;
  }

  void write() {
    const std::span<const std::uint8_t> waiting = session_.outbox().waiting();
    if (absent_ || waiting.empty()) return;
    const base::Result<std::size_t> taken = link_.write(waiting);
    if (taken) {
      session_.outbox().sent(*taken);
    } else if (taken.error() == base::Error::kGone) {
      note_failure(taken.error());
    }
  }

  void note_failure(base::Error error) {
    const bool gone = error == base::Error::kGone;
    if (gone && !absent_) session_.link_lost();
    absent_ = gone;
    if (!gone && error != base::Error::kNotReady) ++faults_;
  }

  Link& link_;
  Conversation session_;
  std::array<std::uint8_t, kChunk> buffer_{};
  std::size_t at_ = 0;
  std::size_t size_ = 0;
  base::Time arrived_;
  Sample latest_;
  bool any_ = false;
  bool absent_ = false;
  std::uint32_t stale_ = 0;
  std::uint32_t faults_ = 0;
};

}  // namespace fencepost::serial
