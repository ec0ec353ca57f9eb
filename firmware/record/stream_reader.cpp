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

void StreamReader::store(std::string_view bytes) {
  const std::size_t room = buffer_.size() - std::min(size_, buffer_.size());
  std::copy_n(bytes.begin(), std::min(bytes.size(), room),
              buffer_.begin() + static_cast<std::ptrdiff_t>(buffer_.size() - room));
  size_ = std::min(size_ + bytes.size(), buffer_.size() + 1);
}

std::optional<std::string_view> StreamReader::cut_line() {
  if (size_ > buffer_.size()) return std::nullopt;
  const std::string_view line(buffer_.data(), size_);
  size_ = 0;
  return without_return(line);
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
