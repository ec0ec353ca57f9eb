#include "drivers/cognachrome/decoder.hpp"

#include <algorithm>
#include <utility>

#include "drivers/serial/largest_first.hpp"

namespace fencepost::cognachrome {
namespace {

constexpr std::uint8_t kStreamBreak = 0xFE;
constexpr std::int32_t kBase = 254;
constexpr std::int32_t kMaxPixels = kWidth * kHeight;

/// Value of a hex digit, or 16.
std::int32_t hex_digit(std::uint8_t c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return 16;
}

bool is_blank(std::uint8_t c) { return c == ' ' || c == '\r' || c == '\n'; }

// A square of so many pixels: across, a pixel is 16/15 of what it is down.
std::int32_t width_of(std::int32_t pixels) {
  std::int32_t width = 1;
  while ((width + 1) * (width + 1) * 16 <= pixels * 15) ++width;
  return width;
}

}  // namespace

std::optional<sensor::Blob> blob_of(std::size_t channel, std::int32_t column, std::int32_t row, std::int32_t pixels) {
  if (column >= kWidth || row >= kHeight || pixels < 1 || pixels > kMaxPixels) return std::nullopt;
  const std::int32_t width = width_of(pixels);
  const std::int32_t left = column - (width - 1) / 2;
  sensor::Blob blob;
  blob.signature = static_cast<std::uint8_t>(channel + 1);
  blob.x1 = static_cast<std::int16_t>(std::max(left, std::int32_t{0}));
  blob.x2 = static_cast<std::int16_t>(std::min(left + width, kWidth) - 1);
  blob.y1 = 0;
  blob.y2 = static_cast<std::int16_t>(kHeight - 1);
  blob.cx = {10 * column};
  blob.cy = {10 * row};
  blob.pixels = static_cast<std::uint32_t>(pixels);
  return blob;
}

bool Decoder::feed(std::uint8_t byte, base::Time now) {
  if (state_ != State::kOutside && std::exchange(given_, false)) frame_ = {mark_at_, 0, {}};
  if (byte == format_.mark) return begin(now);
  // The device says something else, on another stream.
  if (format_.encoding == Encoding::kBase254 && byte == kStreamBreak) {
    const bool complete = end();
    state_ = State::kOutside;
    return complete;
  }
  switch (state_) {
    case State::kOutside: break;
    case State::kCount:
      if (hex_digit(byte) > 15) {
        break_frame();
      } else if (++bytes_ == format_.count_digits) {
        state_ = State::kRecord;
      }
      break;
    case State::kRecord: take_mark(byte); break;
    case State::kFields: format_.encoding == Encoding::kHex ? take_digit(byte) : take_binary(byte); break;
  }
  return false;
}

bool Decoder::begin(base::Time now) {
  const bool complete = end();
  state_ = format_.count_digits > 0 ? State::kCount : State::kRecord;
  bytes_ = 0;
  mark_at_ = now;
  given_ = true;
  return complete;
}

bool Decoder::end() {
  if (state_ == State::kFields && format_.encoding == Encoding::kHex && last_field_is_whole()) end_record();
  if (state_ == State::kOutside) return false;
  if (state_ != State::kRecord) {
    break_frame();
    return false;
  }
  saw_ = !frame_.blobs.empty();
  frame_.frame = counts_.frames++;
  return true;
}

void Decoder::take_mark(std::uint8_t byte) {
  const auto* const found = std::find(format_.channels.begin(), format_.channels.end(), byte);
  if (found != format_.channels.end()) {
    channel_ = static_cast<std::uint8_t>(found - format_.channels.begin());
    field_ = bytes_ = 0;
    values_ = {};
    state_ = State::kFields;
  } else if (format_.encoding != Encoding::kHex || !is_blank(byte)) {
    break_frame();
  }
}

void Decoder::take_binary(std::uint8_t byte) {
  values_[field_] = values_[field_] * kBase + byte;
  if (++bytes_ == 2) next_field();
}

void Decoder::take_digit(std::uint8_t byte) {
  if (const std::int32_t digit = hex_digit(byte); digit < 16) {
    values_[field_] = values_[field_] * 16 + digit;
    if (++bytes_ > 2) break_frame();
  } else if (byte == ':' && bytes_ > 0 && field_ + 1U < format_.size()) {
    next_field();
  } else if (last_field_is_whole()) {
    end_record();
    if (state_ == State::kRecord) take_mark(byte);
  } else {
    break_frame();
  }
}

void Decoder::next_field() {
  ++field_;
  bytes_ = 0;
  if (field_ == format_.size()) end_record();
}

void Decoder::end_record() {
  std::int32_t column = 0;
  std::int32_t row = 0;
  std::int32_t pixels = 0;
  for (std::size_t i = 0; i < format_.size(); ++i) {
    switch (format_.fields[i]) {
      case Field::kColumn: column = values_[i]; break;
      case Field::kRow: row = values_[i]; break;
      case Field::kPixels: pixels = values_[i]; break;
      case Field::kRootOfPixels: pixels = values_[i] * values_[i]; break;
      case Field::kNone:
      case Field::kIgnored: break;
    }
  }
  const std::optional<sensor::Blob> blob = blob_of(channel_, column, row, pixels);
  if (!blob) return break_frame();
  if (!serial::insert_largest_first(frame_, *blob)) ++counts_.blobs_dropped;
  state_ = State::kRecord;
}

void Decoder::break_frame() {
  ++counts_.broken;
  state_ = State::kOutside;
}

}  // namespace fencepost::cognachrome
