#include "host/view/growing_log.hpp"

#include <algorithm>

namespace fencepost::host {
namespace {

constexpr std::size_t kBlock = 64 * 1024;
constexpr std::size_t kMinBlocks = 8;  ///< of which one at a time is forgotten

}  // namespace

GrowingLog::GrowingLog(std::size_t capacity)
    : capacity_(capacity), block_(std::clamp(capacity / kMinBlocks, std::size_t{1}, kBlock)) {}

void GrowingLog::add(std::string_view lines) {
  if (lines.empty()) return;
  const std::lock_guard lock(mutex_);
  if (blocks_.empty() || blocks_.back().text.size() >= block_) blocks_.push_back({end_, {}});
  blocks_.back().text += lines;
  end_ += lines.size();
  while (end_ - blocks_.front().begin > capacity_ && blocks_.size() > 1) forget_oldest();
}

void GrowingLog::forget_oldest() {
  std::string_view text = blocks_.front().text;
  while (!text.empty()) {
    const std::size_t size = std::min(text.find('\n'), text.size() - 1) + 1;
    const std::string_view line = text.substr(0, size);
    if (line.starts_with("$FPHDR,")) header_ = line;
    if (CalibrationLines::is_one(line)) before_.note(line);
    text.remove_prefix(size);
  }
  blocks_.pop_front();
}

void GrowingLog::end() {
  const std::lock_guard lock(mutex_);
  ended_ = true;
}

GrowingLog::Start GrowingLog::start() const {
  const std::lock_guard lock(mutex_);
  if (blocks_.empty()) return {{}, end_};
  return {header_ + before_.in_force(), blocks_.front().begin};
}

GrowingLog::Part GrowingLog::read(std::uint64_t place) const {
  const std::lock_guard lock(mutex_);
  Part part;
  part.place = place;
  if (place >= end_) {
    part.ended = ended_;
    return part;
  }
  const auto next = std::ranges::upper_bound(blocks_, place, {}, &Block::begin);
  if (next == blocks_.begin()) {
    part.lost = true;
    return part;
  }
  const Block& block = *std::prev(next);
  part.bytes = block.text.substr(static_cast<std::size_t>(place - block.begin));
  part.place = block.begin + block.text.size();
  return part;
}

}  // namespace fencepost::host
