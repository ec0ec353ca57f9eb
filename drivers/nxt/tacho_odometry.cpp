#include "drivers/nxt/tacho_odometry.hpp"

namespace fencepost::nxt {
namespace {

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
      sample = take(static_cast<std::uint32_t>(tacho_of(reply)), exchange_.t);
    }
  }
  exchange_.state = Exchange::State::kIdle;
  ask(now);
  if (!sample) return base::Error::kNotReady;
  return *sample;
}

void TachoOdometry::ask(base::Time now) {
  // The brick may have restarted during a silence; its counts then begin at zero.
  if (session_ != conversation_.sessions()) start_anew();
  session_ = conversation_.sessions();
  if (conversation_.link() != sensor::LinkState::kOk || (next_ && now < *next_)) return;
  exchange_.request = get_output_state(right_next_ ? options_.right_port : options_.left_port);
  if (conversation_.submit(exchange_) && !right_next_) next_ = now;
}

std::optional<sensor::OdometrySample> TachoOdometry::take(std::uint32_t count, base::Time t) {
  right_next_ = !right_next_;
  if (right_next_) return pairs_.take_left(count, t);
  pairs_.take_right(count, t);
  next_ = next_ ? *next_ + options_.period : t;
  return std::nullopt;
}

void TachoOdometry::start_anew() {
  pairs_.forget();
  right_next_ = false;
}

sensor::LinkState TachoOdometry::link() const {
  const sensor::LinkState brick = conversation_.link();
  return brick == sensor::LinkState::kOk && refused_ ? sensor::LinkState::kUnready : brick;
}

}  // namespace fencepost::nxt
