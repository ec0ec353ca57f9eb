#include "drivers/nxt/tacho_odometry.hpp"

namespace fencepost::nxt {
namespace {

// Two readings of one motor further apart than this say too little about the time between.
constexpr base::Duration kLongestPair = base::milliseconds(500);
constexpr base::Duration kRefusedPause = base::milliseconds(500);

}  // namespace

base::Result<sensor::OdometrySample> TachoOdometry::poll(base::Time now) {
  if (exchange_.under_way()) return base::Error::kNotReady;
  std::optional<sensor::OdometrySample> sample;
  if (exchange_.state == Exchange::State::kFailed) {
    start_anew();
  } else if (exchange_.state == Exchange::State::kDone) {
    const Reply reply = exchange_.reply();
    refused_ = reply.status != status::kOk;
    if (refused_) {
      start_anew();
      next_ = now + kRefusedPause;
    } else {
      sample = take({tacho_of(reply), exchange_.t});
    }
  }
  exchange_.state = Exchange::State::kIdle;
  ask(now);
  if (!sample) return base::Error::kNotReady;
  return *sample;
}

void TachoOdometry::ask(base::Time now) {
  // Silence may have been a new start of the brick, and its counts begin at zero then.
  if (session_ != conversation_.sessions()) start_anew();
  session_ = conversation_.sessions();
  if (conversation_.link() != sensor::LinkState::kOk || (next_ && now < *next_)) return;
  exchange_.request = get_output_state(right_next_ ? options_.right_port : options_.left_port);
  if (conversation_.submit(exchange_) && !right_next_) next_ = now;
}

std::optional<sensor::OdometrySample> TachoOdometry::take(const Reading& reading) {
  if (right_next_) {
    right_ = reading;
    right_next_ = false;
    next_ = next_ ? *next_ + options_.period : reading.t;
    return std::nullopt;
  }
  std::optional<sensor::OdometrySample> sample;
  if (left_ && right_ && reading.t - left_->t <= kLongestPair) {
    const std::int32_t left = left_at(right_->t, reading);
    sample = drive_.take(static_cast<std::uint32_t>(left), static_cast<std::uint32_t>(right_->count), right_->t);
  }
  left_ = reading;
  right_.reset();
  right_next_ = true;
  return sample;
}

std::int32_t TachoOdometry::left_at(base::Time t, const Reading& after) const {
  const std::int64_t span = (after.t - left_->t).raw;
  // Counts wrap; their difference does not.
  const auto counts =
      static_cast<std::int32_t>(static_cast<std::uint32_t>(after.count) - static_cast<std::uint32_t>(left_->count));
  const std::int64_t part = span <= 0 ? 0 : odometry::divide_nearest(counts * (t - left_->t).raw, span);
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(left_->count) + static_cast<std::uint32_t>(part));
}

void TachoOdometry::start_anew() {
  left_.reset();
  right_.reset();
  right_next_ = false;
  drive_.forget_counts();
}

sensor::LinkState TachoOdometry::link() const {
  const sensor::LinkState brick = conversation_.link();
  return brick == sensor::LinkState::kOk && refused_ ? sensor::LinkState::kUnready : brick;
}

}  // namespace fencepost::nxt
