// Frames of the alert with what they say, for dbc_check.py: id, bytes, and each signal by its name in the DBC file.
#include <fmt/format.h>

#include "host/live/can_alert.hpp"

using namespace fencepost;  // NOLINT(google-build-using-namespace): a main program

namespace {

void print(const host::AlertNow& alert, std::uint8_t counter) {
  const bus::CanFrame frame = host::alert_frame({}, alert, counter);
  fmt::print("{:x} ", frame.id);
  for (const std::uint8_t byte : frame.bytes()) fmt::print("{:02x}", byte);
  const auto& of = alert.of;
  fmt::print(
      " Level={} MayMove={} Camera={} Odometry={} SpeedLimit={:.2f} Distance={:.3f} Bearing={:.3f} "
      "TimeToContact={:.1f} "
      "Counter={}\n",
      name(alert.beat.level), alert.may_move ? "yes" : "no", name(alert.beat.camera), name(alert.beat.odometry),
      !alert.may_move           ? 0.0
      : alert.speed_limit.speed ? alert.speed_limit.speed->to_double()
                                : 1.55,
      of ? of->distance.to_double() : 65.535, of ? of->bearing.to_double() : -32.768,
      of && of->ttc ? of->ttc->to_double() : 25.5, counter);
}

}  // namespace

int main() {
  constexpr std::array kStates = {sensor::LinkState::kAbsent, sensor::LinkState::kSilent, sensor::LinkState::kUnready,
                                  sensor::LinkState::kEmpty, sensor::LinkState::kOk};
  std::uint8_t counter = 250;
  for (int level = 0; level < 5; ++level) {
    for (const sensor::LinkState state : kStates) {
      host::AlertNow alert;
      alert.beat = {{}, static_cast<record::AlertLevel>(level), state, kStates[static_cast<std::size_t>(level)]};
      alert.may_move = level == 1;
      if (state != sensor::LinkState::kEmpty)
        alert.speed_limit.speed = base::Metres{base::Metres::rep{500 * counter % 15'000}};
      if (level > 0 && level < 4) {
        alert.of.emplace();
        alert.of->distance = base::Metres{base::Metres::rep{1'230 * level}};
        alert.of->bearing = base::Radians{base::Radians::rep{-10'000 + 7'770 * level}};
        if (level > 1) alert.of->ttc = base::Duration{11'000 * level};
      }
      print(alert, counter++);
    }
  }
}
