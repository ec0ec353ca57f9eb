#include "firmware/record/stream_reader.hpp"

#include <algorithm>

#include "hal/base/check.hpp"

namespace fencepost::record {

// No more than kBuffer is used, or "\r\n" would let one character too many through.
StreamReader::StreamReader(std::span<char> buffer) : buffer_(buffer.first(std::min(buffer.size(), kBuffer))) {
  FENCEPOST_CHECK(buffer_.size() >= kMinBuffer);
}

std::optional<LineOutcome> StreamReader::finish() {
  if (size_ == 0) return std::nullopt;
  const bool record = starts_a_record();
  size_ = 0;
  return record ? lines_.count_rejected(Reject::kTruncated) : lines_.count_foreign();
}

void StreamReader::store(char byte) {
  if (size_ < buffer_.size()) buffer_[size_] = byte;
  if (size_ <= buffer_.size()) ++size_;
}

std::optional<std::string_view> StreamReader::cut_line() {
  if (size_ > buffer_.size()) return std::nullopt;
  std::string_view line(buffer_.data(), size_);
  if (line.ends_with('\r')) line.remove_suffix(1);
  size_ = 0;
  return line;
}

LineOutcome StreamReader::end_long_line() {
  const bool record = starts_a_record();
  size_ = 0;
  return record ? lines_.count_rejected(Reject::kLength) : lines_.count_foreign();
}

bool StreamReader::starts_a_record() const {
  return std::string_view(buffer_.data(), std::min(size_, buffer_.size())).starts_with(kRecordStart);
}

}  // namespace fencepost::record
