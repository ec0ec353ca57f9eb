#include "host/emulate/models/can_wheels.hpp"

namespace fencepost::emulate {

void CanWheels::turn(std::int32_t left, std::int32_t right, std::int16_t left_rate, std::int16_t right_rate) {
  wheels_[0].count = left;
  wheels_[1].count = right;
  wheels_[0].rate = left_rate;
  wheels_[1].rate = right_rate;
}

void CanWheels::restart(base::Time now) {
  for (Wheel& wheel : wheels_) {
    wheel.zero = wheel.count;
    wheel.next = now + kBoot + (&wheel == wheels_ ? base::Duration{} : kPhase);
  }
}

std::vector<bus::CanFrame> CanWheels::frames(base::Time now) {
  std::vector<bus::CanFrame> due;
  for (std::uint32_t i = 0; i < 2; ++i) {
    if (now < wheels_[i].next) continue;
    wheels_[i].next = wheels_[i].next + kPeriod;
    due.push_back(frame(wheels_[i], i));
  }
  return due;
}

bus::CanFrame CanWheels::frame(const Wheel& wheel, std::uint32_t index) const {
  const auto position = static_cast<std::uint32_t>(wheel.count - wheel.zero);
  const auto byte = [position](unsigned shift) { return static_cast<std::uint8_t>(position >> shift & 0xFFU); };
  const auto rate = static_cast<std::uint16_t>(wheel.rate);
  bus::CanFrame frame;
  if (kind_ == Kind::kCanopen) {
    frame.id = 0x185U + index;
    frame.length = 6;
    frame.data = {0x37, 0x06, byte(0), byte(8), byte(16), byte(24), 0, 0};
  } else {
    frame.id = 0x02041443U + index;
    frame.extended = true;
    frame.length = 8;
    frame.data = {
        byte(16), byte(8), byte(0), static_cast<std::uint8_t>(rate >> 8U), static_cast<std::uint8_t>(rate & 0xFFU),
        0,        0,       0};
  }
  return frame;
}

}  // namespace fencepost::emulate
