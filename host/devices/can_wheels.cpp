// Wheel controllers on a CAN bus.
#include "drivers/can_wheels/odometry.hpp"
#include "hal/linux/can.hpp"
#include "host/devices/options.hpp"
#include "host/devices/ported.hpp"

namespace fencepost::devices {

Rows can_wheels();

namespace {

// Any; a count of 0.1 mm is easy to read.
constexpr emulate::WheelShape kCanWheels{0.0001, 0.235};

class CanPort final : public host::AwaitedPort<host::Port, linux::Can> {
 public:
  using AwaitedPort::AwaitedPort;
  base::Result<bus::CanFrame> receive() {
    if (bus() == nullptr) return base::Error::kGone;
    return bus()->receive();
  }
};

linux::CanFilter filter_of(const can_wheels::Signal& signal) {
  linux::CanFilter filter;
  filter.id = signal.id;
  filter.extended = signal.extended;
  return filter;
}

std::unique_ptr<host::OdometryDevice> open_can_wheels(const Opening& opening) {
  const auto& mapping = opening.robot.can;
  if (!mapping) {
    throw host::DeviceFailure{true, opening.spec.where() +
                                        ": which frames carry the wheels is not known; add \"can\" to a --robot "
                                        "file, see share/doc/live.md"};
  }
  const linux::CanSettings settings{opening.spec.place.name, {filter_of(mapping->left), filter_of(mapping->right)}};
  auto port =
      std::make_unique<CanPort>([settings, clock = opening.clock] { return linux::Can::open(settings, clock); });
  using Wheels = Ported<can_wheels::Odometry<CanPort>, CanPort>;
  return std::make_unique<host::PortedOdometry<Wheels>>(kTalks, host::opened(std::move(port), opening.port()),
                                                        *mapping);
}

std::unique_ptr<emulate::DeviceModel> make(const DeviceSpec& spec, const emulate::Colours& /*colours*/) {
  using Kind = emulate::CanWheels::Kind;
  const Kind kind = spec.option("layout") == "talon" ? Kind::kTalonSrx : Kind::kCanopen;
  return emulate::make_can_model(kind, {spec.real("tick"), spec.real("track")});
}

}  // namespace

Rows can_wheels() {
  std::vector<Option> options = wheel_options(0, kCanWheels);
  options.push_back(
      {"layout", Words{{"canopen", "talon"}}, "canopen", "TPDO1 of nodes 5 and 6, or status 2 of devices 3 and 4"});
  return {{.name = "can",
           .about = "wheels on CAN; the mapping is in the robot file",
           .role = Role::kOdometry,
           .live = Live{.places = {PlaceKind::kCan},
                        .options = {},
                        .unready = "one wheel is missing, or its frames are too short: check \"can\" in the robot file",
                        .driver = OdometryDriver{open_can_wheels}},
           .emulated = Emulated{.tells = "counts, each 20 ms",
                                .options = options,
                                .describe = emulate::describe_can,
                                .make = make,
                                .wheels = kCanWheels,
                                .places = {PlaceKind::kCan}},
           .tried = {{PlaceKind::kCan, "", "RunOnKvaser.FollowsEmulatedWheelsThroughTheInterfaceGoingDown",
                      "candump, canplayer, cangen, python-can"}}}};
}

}  // namespace fencepost::devices
