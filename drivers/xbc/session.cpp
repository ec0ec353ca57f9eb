#include "drivers/xbc/session.hpp"

namespace fencepost::xbc {
namespace {

constexpr std::int32_t kOurVersion = 1;
constexpr base::Duration kPatience = base::milliseconds(1'000);

}  // namespace

bool Session::take(std::uint8_t byte, base::Time now) {
  const Event event = decoder_.feed(byte, now);
  if (event == Event::kNone) return false;
  hearing_.heard = now;
  if (event == Event::kVersion) version_ = decoder_.version();
  const bool understood = version_ == 0 || version_ == kOurVersion;
  if (!understood) hearing_.framed.reset();
  if (event != Event::kFrame || !understood) return false;
  hearing_.framed = now;
  return true;
}

void Session::step(base::Time now) {
  hearing_.step(now, kPatience);
  // Also while it is silent: detects a program started late, and one of another version.
  if (begun_ && (now < next_question_ || (hearing_.heard && version_ != 0))) return;
  if (!hearing_.heard) version_ = 0;
  begun_ = true;
  outbox_.clear();
  (void)outbox_.put("?\n");
  next_question_ = now + kPatience;
}

void Session::link_lost() {
  decoder_.reset();
  begun_ = false;
  hearing_ = {};
  version_ = 0;
  outbox_.clear();
}

sensor::CameraIntrinsics nominal_intrinsics(const sensor::CameraMount& mount) {
  // 178 / tan(22.5 deg).
  constexpr base::Pixels2 kFocal = base::Pixels2::nearest(429.73);
  sensor::CameraIntrinsics intrinsics;
  intrinsics.model = "xbc";
  intrinsics.width = static_cast<std::uint16_t>(kWidth);
  intrinsics.height = static_cast<std::uint16_t>(kHeight);
  intrinsics.fx = kFocal;
  intrinsics.fy = kFocal;
  intrinsics.cx = base::Pixels2::nearest((kWidth - 1) / 2.0);
  intrinsics.cy = base::Pixels2::nearest((kHeight - 1) / 2.0);
  intrinsics.mount = mount;
  intrinsics.latency = base::milliseconds(133);
  return intrinsics;
}

}  // namespace fencepost::xbc
