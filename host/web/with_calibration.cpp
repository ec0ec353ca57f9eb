#include "host/web/with_calibration.hpp"

#include <algorithm>

namespace fencepost::host {
namespace {

constexpr std::string_view kHeader = "$FPHDR,";
constexpr std::string_view kRecord = "$FP";

}  // namespace

std::string_view WithCalibration::next() {
  out_.clear();
  while (out_.empty() && !ended_) {
    const std::string_view bytes = log_();
    take(bytes);
    if (!bytes.empty()) continue;
    ended_ = true;
    if (!in_line_) take_start();
    if (!inserted_) out_ += line_;
  }
  return out_;
}

void WithCalibration::take(std::string_view bytes) {
  while (!bytes.empty()) {
    const std::size_t end = bytes.find('\n');
    if (!in_line_) {
      const std::size_t size = std::min({end, bytes.size(), kHeader.size() - start_.size()});
      start_ += bytes.substr(0, size);
      bytes.remove_prefix(size);
      if (start_.size() == kHeader.size() || end == size) take_start();
      continue;
    }
    const std::size_t size = end == std::string_view::npos ? bytes.size() : end + 1;
    out_ += bytes.substr(0, size);
    bytes.remove_prefix(size);
    if (end == std::string_view::npos) continue;
    in_line_ = false;
    if (header_) out_ += line_;
    inserted_ = inserted_ || header_;
  }
}

void WithCalibration::take_start() {
  header_ = start_ == kHeader;
  if (!inserted_ && !header_ && start_.starts_with(kRecord)) {
    out_ += line_;
    inserted_ = true;
  }
  out_ += start_;
  start_.clear();
  in_line_ = true;
}

}  // namespace fencepost::host
