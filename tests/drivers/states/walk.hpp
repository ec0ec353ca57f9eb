// From each control state that a decoder can reach, each byte, until nothing new is reached.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <deque>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "hal/base/fnv1a.hpp"

namespace fencepost::test {

using Bytes = std::vector<std::uint8_t>;
using Key = base::Fnv1a64;

/// Where a count stands: 0, 1, between, the most less one, the most, beyond.
constexpr std::uint8_t boundary(std::size_t count, std::size_t most) {
  if (count > most) return 5;
  if (count == most) return 4;
  if (count + 1 == most) return 3;
  return count < 2 ? static_cast<std::uint8_t>(count) : std::uint8_t{2};
}

/// Bytes that mean something, and how many messages a decoder at rest has to make of them.
struct Sample {
  Bytes bytes;
  std::uint32_t outputs = 1;
};

struct Plan {
  std::string_view name;
  /// The walk goes along each of them, with every other byte at every place.
  std::vector<Sample> samples;
  /// Said again and again after any state, it is understood...
  Bytes good;
  std::size_t way_back = 0;  ///< ...after so many bytes at most
  std::size_t shortest = 1;  ///< bytes that a message takes at least
};

/// A decoder with what the walk has to know of it.
template <class T>
concept Subject = std::copy_constructible<T> && requires(T subject, const T& seen, Key& key) {
  subject.feed(std::uint8_t{});
  subject.rest();                                             // the line ends, a wait runs out, or it is reset
  { seen.idle() } -> std::convertible_to<bool>;               // as it has to be then
  { seen.outputs } -> std::convertible_to<std::uint32_t>;     // whole messages so far
  { seen.right } -> std::convertible_to<bool>;                // the last byte completed what Plan::good says
  { seen.trouble } -> std::convertible_to<std::string_view>;  // a fault, if there ever was one
  seen.control(key);                                          // the control state; payload content is none of it
  {
    seen.followed(bool{})
    } -> std::convertible_to<bool>;  // false: the bytes in it announce a length between the boundaries
};

struct Walked {
  std::size_t states = 0;
  std::size_t transitions = 0;
  std::size_t way_back = 0;  ///< the longest, in bytes
  std::string trouble;       ///< the first, and the bytes that lead to it
};

/// How far the last bytes are those of a sample.
class Samples {
 public:
  explicit Samples(std::span<const Sample> samples) {
    for (const Sample& sample : samples) {
      std::size_t at = 0;
      for (const std::uint8_t byte : sample.bytes) {
        const auto [next, is_new] = nodes_[at].emplace(byte, nodes_.size());
        at = next->second;
        if (is_new) nodes_.emplace_back();
      }
    }
  }
  static constexpr std::uint32_t kNone = 0xFFFF'FFFF;

  /// `kNone` if they are the beginning of none.
  [[nodiscard]] std::uint32_t find(std::span<const std::uint8_t> bytes) const {
    std::uint32_t at = 0;
    for (std::size_t i = 0; i < bytes.size() && at != kNone; ++i) at = along(at, bytes[i]);
    return at;
  }
  [[nodiscard]] std::uint32_t along(std::uint32_t at, std::uint8_t byte) const {
    const auto found = nodes_[at].find(byte);
    return found == nodes_[at].end() ? kNone : found->second;
  }
  [[nodiscard]] std::uint32_t next(std::uint32_t at, std::uint8_t byte) const {
    if (const std::uint32_t found = along(at, byte); found != kNone) return found;
    const auto anew = nodes_[0].find(byte);
    return anew == nodes_[0].end() ? 0 : anew->second;
  }

 private:
  std::deque<std::map<std::uint8_t, std::uint32_t>> nodes_{1};
};

template <Subject S>
class Walk {
 public:
  Walk(const S& start, const Plan& plan) : start_(start), plan_(plan), samples_(plan.samples) {}

  Walked run() {
    for (const Sample& sample : plan_.samples) try_sample(sample);
    reach({start_, 0, 0, 0, 0});
    for (; at_ < found_.size() && walked_.trouble.empty(); ++at_) {
      const State& state = found_[at_];
      const bool in_sample = state.in_sample != 0 && state.in_sample != Samples::kNone;
      if (!state.subject.followed(in_sample)) continue;
      for (unsigned byte = 0; byte < 256 && walked_.trouble.empty(); ++byte) step(static_cast<std::uint8_t>(byte));
    }
    walked_.states = found_.size();
    return walked_;
  }

 private:
  struct State {
    S subject;
    std::uint32_t in_sample;
    std::size_t depth;
    std::size_t from;
    std::uint8_t byte;
  };

  void step(std::uint8_t byte) {
    ++walked_.transitions;
    const State& from = found_[at_];
    State next{from.subject, 0, from.depth + 1, at_, byte};
    next.subject.feed(byte);
    next.in_sample = place(from, next);
    if (!next.subject.trouble.empty()) return say(next.subject.trouble, next);
    if (next.subject.outputs * plan_.shortest > next.depth) return say("more messages than bytes allow", next);
    reach(std::move(next));
  }

  // A decoder that shows what it is in the middle of is followed in that alone.
  std::uint32_t place(const State& from, const State& next) const {
    if constexpr (requires { next.subject.message(); }) {
      const std::size_t size = next.subject.message().size();
      if (size != from.subject.message().size() + 1) return samples_.find(next.subject.message());
      return from.in_sample == Samples::kNone ? Samples::kNone : samples_.along(from.in_sample, next.byte);
    } else {
      return samples_.next(from.in_sample, next.byte);
    }
  }

  void reach(State&& state) {
    Key key;
    key.u32(state.in_sample);
    state.subject.control(key);
    if (!seen_.insert(key.value()).second) return;
    S rested = state.subject;
    rested.rest();
    if (!rested.idle()) say("not at rest after a reset", state);
    come_back(state);
    found_.push_back(std::move(state));
  }

  void come_back(const State& state) {
    S subject = state.subject;
    for (std::size_t bytes = 1; bytes <= plan_.way_back; ++bytes) {
      subject.feed(plan_.good[(bytes - 1) % plan_.good.size()]);
      if (!subject.trouble.empty()) return say(subject.trouble, state);
      if (!subject.right) continue;
      walked_.way_back = std::max(walked_.way_back, bytes);
      return;
    }
    say("a good message is not understood", state);
  }

  void try_sample(const Sample& sample) {
    S subject = start_;
    for (const std::uint8_t byte : sample.bytes) subject.feed(byte);
    if (!walked_.trouble.empty()) return;
    const std::string after = ", after" + listed(sample.bytes);
    if (!subject.trouble.empty()) {
      walked_.trouble = std::string(subject.trouble) + after;
    } else if (subject.outputs != sample.outputs) {
      walked_.trouble = std::to_string(subject.outputs) + " messages, not " + std::to_string(sample.outputs) + after;
    }
  }

  void say(std::string_view trouble, const State& state) {
    if (!walked_.trouble.empty()) return;
    Bytes bytes;
    for (const State* at = &state; at->depth > 0; at = &found_[at->from]) bytes.insert(bytes.begin(), at->byte);
    walked_.trouble = std::string(trouble) + ", after" + listed(bytes);
  }

  static std::string listed(const Bytes& bytes) {
    constexpr std::string_view kDigits = "0123456789ABCDEF";
    std::string text;
    for (const std::uint8_t byte : bytes) text += {' ', kDigits[byte / 16], kDigits[byte % 16]};
    return text;
  }

  const S& start_;
  const Plan& plan_;
  Samples samples_;
  std::deque<State> found_;
  std::size_t at_ = 0;
  std::unordered_set<std::uint64_t> seen_;
  Walked walked_;
};

template <Subject S>
Walked walk(const S& start, const Plan& plan) {
  return Walk<S>(start, plan).run();
}

}  // namespace fencepost::test
