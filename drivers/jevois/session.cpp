#include "drivers/jevois/session.hpp"

namespace fencepost::jevois {
namespace {

// Ten frames at 20 /s. A module that is loading gets the settings again after each such time.
constexpr base::Duration kPatience = base::milliseconds(500);

constexpr std::string_view kSettings =
    "setpar serout All\n"
    "setpar serstyle Normal\n"
    "setpar serprec 1\n"
    "setpar serstamp Frame\n"
    "setpar sermark Both\n"
    "streamon\n";

}  // namespace

bool Session::take(std::uint8_t byte, base::Time now) {
  const Event event = decoder_.feed(byte, now);
  if (event == Event::kNone) return false;
  hearing_.heard = now;
  if (event != Event::kFrame) return false;
  hearing_.framed = now;
  as_told_ = decoder_.as_told();
  return true;
}

void Session::step(base::Time now) {
  hearing_.step(now, kPatience);
  if (begun_ && ((hearing_.framed && as_told_) || now < next_telling_)) return;
  begun_ = true;
  outbox_.clear();
  (void)outbox_.put(kSettings);
  next_telling_ = now + kPatience;
}

void Session::link_lost() {
  decoder_.reset();
  begun_ = false;
  hearing_ = {};
  outbox_.clear();
}

sensor::CameraIntrinsics nominal_intrinsics(const sensor::CameraMount& mount) {
  // 160 / tan(30 deg).
  constexpr base::Pixels2 kFocal = base::Pixels2::nearest(277.13);
  sensor::CameraIntrinsics intrinsics;
  intrinsics.model = "jevois";
  intrinsics.width = static_cast<std::uint16_t>(kWidth);
  intrinsics.height = static_cast<std::uint16_t>(kHeight);
  intrinsics.fx = kFocal;
  intrinsics.fy = kFocal;
  intrinsics.cx = base::Pixels2::nearest((kWidth - 1) / 2.0);
  intrinsics.cy = base::Pixels2::nearest((kHeight - 1) / 2.0);
  intrinsics.mount = mount;
  intrinsics.latency = base::milliseconds(67);
  return intrinsics;
}

}  // namespace fencepost::jevois
