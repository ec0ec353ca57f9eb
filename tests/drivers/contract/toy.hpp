// A small camera and its driver, sound or with one fault, to show that the contract finds each.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "drivers/serial/largest_first.hpp"
#include "tests/drivers/bench/bench.hpp"
#include "tests/drivers/bench/cable.hpp"

namespace fencepost::test {

enum class Flaw : std::uint8_t {
  kNone,
  kGarbageTakesTheNext,    ///< a byte that is no mark is taken for a frame of three
  kDamageTakesTheNext,     ///< nothing of a damaged frame is scanned again
  kIgnoresItsSum,          ///< its checksum is not looked at
  kForgetsBetweenPolls,    ///< of a frame that is not whole yet
  kDropsUncounted,         ///< blobs
  kKeepsTheFirst,          ///< of too many blobs, not the largest
  kWaitsForTheImpossible,  ///< a count beyond what it has room for
  kTakesAllThatThereIs,    ///< in one poll
  kTrustsBoxes,            ///< wherever they lie, whatever their sum
  kKeepsHalves,            ///< of a frame, when the link is lost
  kSaysNoLoss,             ///< of the link
  kSaysNoSilence,          ///< of the device
  kInventsFrames,          ///< while nothing comes
  kBabbles,                ///< asks at each poll
  kAsksOnce,               ///< and not after a power cycle
  kSaysNoEmptiness,        ///< where nothing is in sight
  kHoldsBack,              ///< a frame until the next one comes
};

/// Sends `7E`, a count, so many times signature, column, row, columns, rows, and the sum of these; once it has heard G.
struct ToyCamera {
  std::vector<std::uint8_t> take(std::uint8_t byte, base::Time /*now*/) {
    asked = asked || byte == 'G';
    return {};
  }
  [[nodiscard]] std::vector<std::uint8_t> image(const std::vector<sensor::Blob>& blobs) const {
    if (!asked) return {};
    std::vector<std::uint8_t> bytes = {0x7E, static_cast<std::uint8_t>(blobs.size())};
    for (const sensor::Blob& blob : blobs) {
      for (const int value :
           {int{blob.signature}, int{blob.x1}, int{blob.y1}, blob.x2 - blob.x1 + 1, blob.y2 - blob.y1 + 1})
        bytes.push_back(static_cast<std::uint8_t>(value));
    }
    unsigned sum = 0;
    for (const std::uint8_t byte : bytes) sum += byte;
    bytes.push_back(static_cast<std::uint8_t>(sum & 0xFFU));
    return bytes;
  }
  bool asked = false;
};

template <class Link, Flaw F>
class ToyDriver {
 public:
  static constexpr int kSide = 128;

  explicit ToyDriver(Link& link) : link_(link) {}

  base::Result<sensor::BlobFrame> poll(base::Time now) {
    frame_.reset();
    receive(now);
    if (heard_ && now - *heard_ > kQuiet && F != Flaw::kSaysNoSilence) state_ = std::min(state_, kSilentState);
    if (F == Flaw::kBabbles || !next_ || (now >= *next_ && state_ <= kSilentState && F != Flaw::kAsksOnce)) ask(now);
    if (F == Flaw::kInventsFrames && now.raw % 100'000 < 20) frame_.emplace().t = now;
    if (!frame_) return base::Error::kNotReady;
    return *frame_;
  }
  [[nodiscard]] sensor::LinkState link() const { return state_; }
  [[nodiscard]] std::uint32_t dropped() const { return dropped_; }

 private:
  static constexpr sensor::LinkState kSilentState = sensor::LinkState::kSilent;
  static constexpr base::Duration kQuiet = base::milliseconds(300);
  static constexpr std::size_t kMax = 20;

  void ask(base::Time now) {
    constexpr std::array<std::uint8_t, 1> kGo = {'G'};
    next_ = now + kQuiet;
    if (const auto sent = link_.write(kGo); !sent && sent.error() == base::Error::kGone) lose();
  }
  void receive(base::Time now) {
    if (F == Flaw::kForgetsBetweenPolls) bytes_.clear();
    std::array<std::uint8_t, 32> in{};
    for (int reads = 0; reads < 8 || F == Flaw::kTakesAllThatThereIs; ++reads) {
      const auto got = link_.read(in);
      if (!got && got.error() == base::Error::kGone) lose();
      if (!got) return;
      if (state_ == sensor::LinkState::kAbsent) state_ = kSilentState;
      for (const std::uint8_t byte : std::span(in).first(*got)) feed(byte, now);
    }
  }
  void lose() {
    if (F != Flaw::kSaysNoLoss) state_ = sensor::LinkState::kAbsent;
    if (F != Flaw::kKeepsHalves) bytes_.clear();
    if (F != Flaw::kAsksOnce) next_.reset();
  }

  void feed(std::uint8_t byte, base::Time now) {
    bytes_.push_back(byte);
    while (const std::size_t used = front(now)) bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<long>(used));
  }
  // Bytes that are done with.
  std::size_t front(base::Time now) {
    if (bytes_.empty()) return 0;
    const bool mark = bytes_[0] == 0x7E;
    if (!mark && F != Flaw::kGarbageTakesTheNext) return 1;
    if (bytes_.size() < 2) return 0;
    const std::size_t count = mark ? bytes_[1] : 3;
    if (count > kMax) return F == Flaw::kWaitsForTheImpossible ? 0 : 1;
    const std::size_t size = 3 + 5 * count;
    if (bytes_.size() < size) return 0;
    unsigned sum = 0;
    for (std::size_t i = 0; i + 1 < size; ++i) sum += bytes_[i];
    const bool sealed = (sum & 0xFFU) == bytes_[size - 1] || F == Flaw::kIgnoresItsSum || F == Flaw::kTrustsBoxes;
    if (mark && sealed && take(count, now)) return size;
    return F == Flaw::kDamageTakesTheNext || !mark ? size : 1;
  }
  bool take(std::size_t count, base::Time now) {
    sensor::BlobFrame frame;
    std::uint32_t dropped = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const auto at = [&](std::size_t field) { return static_cast<std::int16_t>(bytes_[2 + 5 * i + field]); };
      sensor::Blob blob;
      blob.signature = static_cast<std::uint8_t>(at(0));
      blob.x1 = at(1);
      blob.y1 = at(2);
      blob.x2 = static_cast<std::int16_t>(at(1) + at(3) - 1);
      blob.y2 = static_cast<std::int16_t>(at(2) + at(4) - 1);
      const bool inside = at(3) > 0 && at(4) > 0 && blob.x2 < kSide && blob.y2 < kSide;
      if (!inside && F != Flaw::kTrustsBoxes) return false;
      const bool kept =
          F == Flaw::kKeepsTheFirst ? frame.blobs.push_back(blob) : serial::insert_largest_first(frame, blob);
      dropped += kept || F == Flaw::kDropsUncounted ? 0U : 1U;
    }
    frame.t = now;
    dropped_ += dropped;
    heard_ = now;
    const bool empty = frame.blobs.empty() && F != Flaw::kSaysNoEmptiness;
    state_ = empty ? sensor::LinkState::kEmpty : sensor::LinkState::kOk;
    frame_ = F == Flaw::kHoldsBack ? std::exchange(held_, frame) : frame;
    return true;
  }

  Link& link_;
  std::vector<std::uint8_t> bytes_;
  std::optional<sensor::BlobFrame> frame_;
  std::optional<sensor::BlobFrame> held_;
  sensor::LinkState state_ = kSilentState;
  std::optional<base::Time> heard_;
  std::optional<base::Time> next_;
  std::uint32_t dropped_ = 0;
};

template <Flaw F>
struct ToyRig : CameraRig<ToyRig<F>> {
  using Sample = sensor::BlobFrame;
  using Link = Cable<ToyCamera>;
  static constexpr int kWidth = ToyDriver<Link, F>::kSide;
  static constexpr int kHeight = kWidth;

  explicit ToyRig(const fake::SteppedClock& clock, const Damage& damage = {})
      : link(device, clock, damage), driver(link) {
    link.count_frames([](std::span<const std::uint8_t> bytes) { return bytes[0] == 0x7E; });
  }
  void live(base::Time now) {
    if (this->expose(now, base::milliseconds(20))) link.inject(device.image(this->seen()));
  }
  base::Result<Sample> poll(base::Time now) { return driver.poll(now); }
  void restart(base::Time /*now*/) { device.asked = false, link.forget(); }
  static sensor::Blob blob_of(std::int64_t image) {
    sensor::Blob box = moving_box(image, 80, 90);
    box.cx = box.cy = {};
    return box;
  }

  ToyCamera device;
  Link link;
  ToyDriver<Link, F> driver;
};

}  // namespace fencepost::test
