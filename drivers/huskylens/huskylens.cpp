#include "drivers/huskylens/huskylens.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "drivers/serial/largest_first.hpp"
#include "drivers/wire/endian.hpp"

namespace fencepost::huskylens {
namespace {

using sensor::LinkState;

enum Reply : std::uint8_t {
  kInfo = 0x29,
  kBlock = 0x2A,
  kArrow = 0x2B,
  kDone = 0x2E,
  kVersion = 0x3C,
  kBusy = 0x3D,
  kNeedPro = 0x3E
};

constexpr std::uint8_t kFirst = 0x55;
constexpr std::uint8_t kSecond = 0xAA;
constexpr std::uint8_t kThird = 0x11;
constexpr std::size_t kObject = 10;  // data bytes of an INFO, a BLOCK, an ARROW
constexpr std::uint8_t kPatience = 5;

// Checksums are the sums of the bytes before them.
constexpr std::array<std::uint8_t, 6> kKnock = {kFirst, kSecond, kThird, 0x00, 0x2C, 0x3C};
constexpr std::array<std::uint8_t, 8> kColour = {kFirst, kSecond, kThird, 0x02, 0x2D, 0x04, 0x00, 0x43};
constexpr std::array<std::uint8_t, 6> kAskBlocks = {kFirst, kSecond, kThird, 0x00, 0x21, 0x31};

// A damaged header is seen at once, not after the bytes that it promises.
bool plausible(std::uint8_t length, std::uint8_t command) {
  switch (command) {
    case kInfo:
    case kBlock:
    case kArrow: return length == kObject;
    case kDone:
    case kVersion: return length <= kLongestData;
    case kBusy:
    case kNeedPro: return length == 0;
    default: return false;
  }
}

struct Ends {
  std::int32_t first = 0;
  std::int32_t last = 0;
};

// The pixel behind the middle of an even number of pixels is its centre.
Ends inside(std::int32_t centre, std::int32_t size, std::int32_t limit) {
  const std::int32_t first = centre - size / 2;
  return {std::max(first, std::int32_t{0}), std::min(first + size - 1, limit - 1)};
}

}  // namespace

wire::Verdict examine(std::span<const std::uint8_t> bytes) {
  using wire::Front;
  constexpr std::array<std::uint8_t, 3> kStart = {kFirst, kSecond, kThird};
  for (std::size_t i = 0; i < std::min(bytes.size(), kStart.size()); ++i) {
    if (bytes[i] != kStart[i]) return {Front::kNoise, wire::skip_to(bytes, kFirst)};
  }
  if (bytes.size() < 5) return {};
  if (!plausible(bytes[3], bytes[4])) return {Front::kNoise, wire::skip_to(bytes, kFirst)};
  const std::size_t size = kAround + bytes[3];
  if (bytes.size() < size) return {};
  unsigned sum = 0;
  for (std::size_t i = 0; i + 1 < size; ++i) sum += bytes[i];
  if (bytes[size - 1] != wire::low(sum)) return {Front::kDamaged, 1};
  return {Front::kMessage, size};
}

std::optional<sensor::Blob> blob_of(std::span<const std::uint8_t> data) {
  const std::int32_t width = wire::little_u16(data, 4);
  const std::int32_t height = wire::little_u16(data, 6);
  const std::uint16_t id = wire::little_u16(data, 8);
  if (width == 0 || height == 0 || id == 0 || id > 255) return std::nullopt;
  const Ends x = inside(static_cast<std::int16_t>(wire::little_u16(data, 0)), width, kWidth);
  const Ends y = inside(static_cast<std::int16_t>(wire::little_u16(data, 2)), height, kHeight);
  if (x.first > x.last || y.first > y.last) return std::nullopt;
  sensor::Blob blob;
  blob.signature = static_cast<std::uint8_t>(id);
  blob.x1 = static_cast<std::int16_t>(x.first);
  blob.x2 = static_cast<std::int16_t>(x.last);
  blob.y1 = static_cast<std::int16_t>(y.first);
  blob.y2 = static_cast<std::int16_t>(y.last);
  blob.cx = {5 * (x.first + x.last)};
  blob.cy = {5 * (y.first + y.last)};
  return blob;
}

void Session::take(std::uint8_t byte, base::Time now) {
  const std::uint32_t damaged = scanner_.damaged();
  scanner_.feed(byte, now, [&](std::span<const std::uint8_t> message, base::Time first_byte) {
    take_message(message, first_byte, now);
  });
  if (waiting_ && !scanner_.pending().empty()) deadline_ = now + options_.timeout;
  if (scanner_.damaged() == damaged || !waiting_) return;
  // It was of the answer, most likely: there is no point in waiting on.
  ++counts_.broken;
  answered(now, base::milliseconds(20));
}

void Session::take_message(std::span<const std::uint8_t> message, base::Time first_byte, base::Time now) {
  const std::span<const std::uint8_t> data = message.subspan(5, message[3]);
  heard_ = true;
  missed_ = 0;
  if (!waiting_) return;  // the rest of an answer that was given up
  deadline_ = now + options_.timeout;
  switch (message[4]) {
    case kDone:
      if (step_ == Step::kKnock) {
        step_ = options_.select_colour ? Step::kAlgorithm : Step::kBlocks;
      } else if (step_ == Step::kAlgorithm) {
        step_ = Step::kBlocks;
      } else {
        return;
      }
      new_image_ = now;
      return answered(now, {});
    case kBusy:
    case kNeedPro:
      ++counts_.busy;
      work_ = LinkState::kUnready;
      return answered(now, base::milliseconds(50));
    case kInfo: return take_info(data, first_byte, now);
    case kBlock:
      if (!building_) return;
      take_block(data);
      --left_;
      return finish_if_whole(now);
    case kArrow:
      if (!building_) return;
      --left_;
      return finish_if_whole(now);
    default: return;
  }
}

void Session::take_info(std::span<const std::uint8_t> data, base::Time first_byte, base::Time now) {
  if (step_ != Step::kBlocks) return;
  frame_ = {};
  frame_.t = first_byte;
  left_ = wire::little_u16(data, 0);
  taught_ = wire::little_u16(data, 2) > 0;
  building_number_ = wire::little_u16(data, 4);
  building_ = true;
  finish_if_whole(now);
}

void Session::take_block(std::span<const std::uint8_t> data) {
  if (wire::little_u16(data, 8) == 0) ++counts_.not_learned;
  const std::optional<sensor::Blob> blob = blob_of(data);
  if (blob && !serial::insert_largest_first(frame_, *blob)) ++counts_.blobs_dropped;
}

void Session::finish_if_whole(base::Time now) {
  if (!building_ || left_ > 0) return;
  if (number_ == building_number_) {
    ++counts_.stale;
    if (now - new_image_ >= options_.frozen) work_ = LinkState::kUnready;
    return answered(now, base::milliseconds(5));
  }
  number_ = building_number_;
  new_image_ = now;
  work_ = !taught_ ? LinkState::kUnready : frame_.blobs.empty() ? LinkState::kEmpty : LinkState::kOk;
  // Two answers that came in one heap have one time: the older one is given.
  if (!last_t_ || frame_.t > *last_t_) {
    frame_.frame = counts_.frames++;
    last_t_ = frame_.t;
    complete_ = frame_;
  }
  answered(now, {});
}

void Session::answered(base::Time now, base::Duration pause) {
  waiting_ = building_ = false;
  next_ = now + pause;
}

void Session::expire(base::Time now) {
  if (!waiting_ || now < deadline_) return;
  ++counts_.timeouts;
  answered(now, {});
  scanner_.reset();
  if (++missed_ >= kPatience) restart();
}

void Session::restart() {
  ++counts_.restarts;
  step_ = Step::kKnock;
  work_ = LinkState::kUnready;
  heard_ = false;
  missed_ = 0;
  number_.reset();
}

void Session::step(base::Time now) {
  expire(now);
  if (waiting_ || absent_ || now < next_) return;
  switch (step_) {
    case Step::kKnock: wire::replace(outbox_, kKnock); break;
    case Step::kAlgorithm: wire::replace(outbox_, kColour); break;
    case Step::kBlocks: wire::replace(outbox_, kAskBlocks); break;
  }
  waiting_ = true;
  deadline_ = now + options_.timeout;
}

void Session::lose_link() {
  if (std::exchange(absent_, true)) return;
  scanner_.reset();
  outbox_.clear();
  waiting_ = building_ = false;
  next_ = {};
  restart();
}

std::optional<sensor::BlobFrame> Session::take_frame() { return std::exchange(complete_, std::nullopt); }

LinkState Session::link() const {
  if (absent_) return LinkState::kAbsent;
  return heard_ ? work_ : LinkState::kSilent;
}

}  // namespace fencepost::huskylens
