#include "drivers/create/stream_decoder.hpp"

#include "hal/base/check.hpp"

namespace fencepost::create {
namespace {

std::uint8_t length_of(const StreamLayout& layout) {
  std::size_t length = 3;
  for (const StreamField& field : layout) {
    FENCEPOST_CHECK(field.size == 1 || field.size == 2);
    length += 1U + field.size;
  }
  return static_cast<std::uint8_t>(length);
}

}  // namespace

StreamDecoder::StreamDecoder(const StreamLayout& layout) : layout_(layout), length_(length_of(layout)) {}

bool StreamDecoder::feed(std::uint8_t byte, base::Time now) {
  if (filled_ == length_) {
    for (std::size_t i = 1; i < length_; ++i) {
      window_[i - 1] = window_[i];
      arrived_[i - 1] = arrived_[i];
    }
    --filled_;
  }
  window_[filled_] = byte;
  arrived_[filled_] = now;
  ++filled_;
  if (filled_ < length_ || !has_shape()) return false;
  if (!check_sum()) {
    ++bad_checksums_;
    return false;
  }
  read_values();
  t_ = arrived_[0];
  filled_ = 0;
  return true;
}

bool StreamDecoder::has_shape() const {
  if (window_[0] != kHeader || window_[1] != length_ - 3) return false;
  std::size_t at = 2;
  for (const StreamField& field : layout_) {
    if (window_[at] != field.id) return false;
    at += 1U + field.size;
  }
  return true;
}

bool StreamDecoder::check_sum() {
  unsigned sum = 0;
  for (std::size_t i = 1; i < length_; ++i) sum += window_[i];
  ChecksumRule found = ChecksumRule::kUnknown;
  if (sum % 256 == 0) found = ChecksumRule::kWithoutHeader;
  if ((sum + kHeader) % 256 == 0) found = ChecksumRule::kWithHeader;
  if (found == ChecksumRule::kUnknown) return false;
  if (found == rule_) {
    if (agreed_ < kAgreement) ++agreed_;
    return true;
  }
  if (agreed_ == kAgreement) return false;
  rule_ = found;
  agreed_ = 1;
  return true;
}

void StreamDecoder::read_values() {
  std::size_t at = 2;
  for (std::size_t i = 0; i < layout_.size(); ++i) {
    unsigned value = 0;
    for (std::size_t k = 1; k <= layout_[i].size; ++k) value = 256 * value + window_[at + k];
    values_[i] = static_cast<std::uint16_t>(value);
    at += 1U + layout_[i].size;
  }
}

}  // namespace fencepost::create
