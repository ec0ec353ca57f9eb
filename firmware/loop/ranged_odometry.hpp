// Odometry within the range of the record stream. Beyond it nothing could be logged and replayed, so nothing is used,
// in any mode, and the link is reported as unready.
#pragma once

#include "firmware/console/link_words.hpp"
#include "firmware/record/run_rules.hpp"
#include "hal/sensor/sources.hpp"

namespace fencepost::loop {

/// `words` of any type with the members of console::LinkWords.
template <class Words>
void explain_range(Words& words) {
  words.detail = "out of range";
  words.remedy = "its position is more than 1000 m from its origin; start it anew";
}

/// The source, but unready as long as its latest sample is out of range. The pipeline rejects and counts such samples.
template <sensor::OdometrySource Source>
class RangedOdometry {
 public:
  explicit RangedOdometry(Source& source) : source_(source) {}

  base::Result<sensor::OdometrySample> poll(base::Time now) {
    const base::Result<sensor::OdometrySample> sample = source_.poll(now);
    if (sample) in_range_ = record::inside_range(*sample);
    return sample;
  }
  [[nodiscard]] bool in_range() const { return in_range_; }
  [[nodiscard]] sensor::LinkState link() const {
    const sensor::LinkState state = source_.link();
    return in_range_ || state < sensor::LinkState::kUnready ? state : sensor::LinkState::kUnready;
  }
  [[nodiscard]] bool stamped_here() const { return sensor::stamped_here(source_); }
  [[nodiscard]] auto link_words(sensor::LinkState state) const {
    auto words = console::link_words(source_, "odometry", state);
    if (!in_range_ && state == sensor::LinkState::kUnready) explain_range(words);
    return words;
  }

 private:
  Source& source_;
  bool in_range_ = true;
};

}  // namespace fencepost::loop
