// A decoder that is a wire::Scanner: what it is in the middle of is all of its state.
#pragma once

#include <algorithm>
#include <array>

#include "drivers/wire/scanner.hpp"
#include "hal/sensor/blob_frame.hpp"
#include "tests/drivers/seal/seal.hpp"
#include "tests/drivers/states/walk.hpp"

namespace fencepost::test {

using View = std::span<const std::uint8_t>;

/// The base of every subject.
struct Seen {
  [[nodiscard]] static bool followed(bool /*in_sample*/) { return true; }

  std::uint32_t outputs = 0;
  bool right = false;
  std::string_view trouble;
};

/// `Protocol` has kCapacity, examine() and good(), a message. trouble(message): the fault of one that was found.
/// control(pending, key): the header's meaning as far as it is there; followed(pending).
template <class Protocol>
struct Scanned : Seen {
  void feed(std::uint8_t byte) {
    right = false;
    scanner.feed(byte, {}, [&](View message, base::Time) {
      ++outputs;
      if (const std::string_view said = Protocol::trouble(message); !said.empty()) trouble = said;
      static const Bytes kGood = Protocol::good();
      right = std::equal(message.begin(), message.end(), kGood.begin(), kGood.end());
    });
    if (scanner.pending().size() >= Protocol::kCapacity) trouble = "the buffer stays full";
    if (scanner.messages() != outputs) trouble = "messages are miscounted";
  }
  void rest() { scanner.reset(); }
  [[nodiscard]] bool idle() const { return scanner.pending().empty(); }
  void control(Key& key) const {
    key.u16(static_cast<std::uint16_t>(scanner.pending().size()));
    Protocol::control(scanner.pending(), key);
  }
  [[nodiscard]] bool followed(bool in_sample) const { return in_sample || Protocol::followed(scanner.pending()); }
  [[nodiscard]] View message() const { return scanner.pending(); }

  wire::Scanner<Protocol::kCapacity, Protocol::examine> scanner;
};

/// A walk of a Scanner, by its protocol.
template <class Protocol>
Walked walk_scanner() {
  Plan plan;
  plan.samples = Protocol::samples();
  plan.good = Protocol::good();
  plan.way_back = Protocol::kWayBack;
  plan.shortest = Protocol::kShortest;
  return walk(Scanned<Protocol>{}, plan);
}

/// The boundary that a length is, or the mark of all that lie between.
template <std::size_t Count>
constexpr std::uint16_t one_of(std::size_t length, const std::array<std::uint16_t, Count>& boundaries) {
  for (const std::uint16_t each : boundaries) {
    if (length == each) return each;
  }
  return 0xFFFF;
}

inline Bytes repeated(const Bytes& bytes, std::size_t times) {
  Bytes all;
  for (std::size_t i = 0; i < times; ++i) all.insert(all.end(), bytes.begin(), bytes.end());
  return all;
}

inline Bytes text(std::string_view text) { return {text.begin(), text.end()}; }

inline Bytes operator+(Bytes a, const Bytes& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

inline bool inside(const sensor::Blob& blob, int width, int height) {
  return 0 <= blob.x1 && blob.x1 <= blob.x2 && blob.x2 < width && 0 <= blob.y1 && blob.y1 <= blob.y2 &&
         blob.y2 < height;
}

inline bool inside(const sensor::BlobFrame& frame, int width, int height) {
  return std::all_of(frame.blobs.begin(), frame.blobs.end(),
                     [&](const sensor::Blob& blob) { return blob.signature > 0 && inside(blob, width, height); });
}

}  // namespace fencepost::test
