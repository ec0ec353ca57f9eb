#include "host/recorder/tally.hpp"

namespace fencepost::host {

void Tally::take(std::string_view bytes, base::Time now) {
  bytes_ += bytes.size();
  const std::uint32_t before = lines();
  reader_.push(bytes, losses_);
  if (lines() != before) last_line_ = now;
}

void Tally::finish() { reader_.finish(); }

void Tally::measure(base::Time now) {
  const double seconds = (now - measured_at_).to_double();
  if (seconds <= 0) return;
  rates_ = {(lines() - lines_measured_) / seconds, static_cast<double>(bytes_ - bytes_measured_) / seconds};
  measured_at_ = now;
  lines_measured_ = lines();
  bytes_measured_ = bytes_;
}

}  // namespace fencepost::host
