#include "host/live/open_odometry.hpp"

#include "drivers/can_wheels/odometry.hpp"
#include "drivers/create/create.hpp"
#include "drivers/nxt/tacho_odometry.hpp"
#include "drivers/serial/pump.hpp"
#include "hal/linux/can.hpp"
#include "host/live/open_port.hpp"
#include "host/live/records_odometry.hpp"

namespace fencepost::host {
namespace {

using base::milliseconds;
using Odometry = std::unique_ptr<OdometryDevice>;

constexpr std::uint32_t kCreate1Baud = 57'600;
constexpr std::uint32_t kUsualBaud = 115'200;

/// These talk without being asked, and what they do not say is noticed in tenths of a second.
constexpr base::Duration kTalks = milliseconds(50);
constexpr base::Duration kBrickAsked = milliseconds(4);

template <class Driver>
struct Serial {
  template <class... Arguments>
  explicit Serial(std::unique_ptr<BytePort> port, Arguments&&... arguments)
      : line(std::move(port)), driver(*line, std::forward<Arguments>(arguments)...) {}
  [[nodiscard]] Port& port() const { return *line; }

  std::unique_ptr<BytePort> line;
  Driver driver;
};

Odometry open_create(const DeviceSpec& spec, const RobotFile& robot, bool wait) {
  create::Config config;
  const bool first = spec.kind == DeviceKind::kCreate1;
  config.model = first ? create::Model::kCreate1 : create::Model::kCreate2;
  config.wheels = robot.wheels.over(config.wheels);
  const std::string mode = spec.option("mode", "passive");
  if (mode == "safe") config.mode = create::Mode::kSafe;
  if (mode == "full") config.mode = create::Mode::kFull;
  using Stack = Serial<create::Create<BytePort>>;
  return std::make_unique<PortedOdometry<Stack>>(kTalks, open_byte_port(spec, first ? kCreate1Baud : kUsualBaud, wait),
                                                 config);
}

Odometry open_records(const DeviceSpec& spec, bool wait) {
  const bool own = spec.option("stamp", "arrival") == "own";
  using Stack = Serial<serial::Pump<BytePort, RecordsSession>>;
  return std::make_unique<PortedOdometry<Stack>>(kTalks, open_byte_port(spec, kUsualBaud, wait),
                                                 own ? RecordStamp::kOwn : RecordStamp::kArrival);
}

class CanPort final : public AwaitedPort<Port, linux::Can> {
 public:
  using AwaitedPort::AwaitedPort;
  base::Result<bus::CanFrame> receive() {
    if (bus() == nullptr) return base::Error::kGone;
    return bus()->receive();
  }
};

struct WheelsOnCan {
  WheelsOnCan(std::unique_ptr<CanPort> bus, const can_wheels::Mapping& mapping)
      : can(std::move(bus)), driver(*can, mapping) {}
  [[nodiscard]] Port& port() const { return *can; }

  std::unique_ptr<CanPort> can;
  can_wheels::Odometry<CanPort> driver;
};

linux::CanFilter filter_of(const can_wheels::Signal& signal) {
  linux::CanFilter filter;
  filter.id = signal.id;
  filter.extended = signal.extended;
  return filter;
}

Odometry open_can(const DeviceSpec& spec, const RobotFile& robot, linux::MonotonicClock clock, bool wait) {
  if (!robot.can) {
    throw DeviceFailure{true, spec.where() +
                                  ": which frames carry the wheels is not known; add \"can\" to a --robot "
                                  "file, see share/doc/live.md"};
  }
  const linux::CanSettings settings{spec.place.name, {filter_of(robot.can->left), filter_of(robot.can->right)}};
  auto port = std::make_unique<CanPort>([settings, clock] { return linux::Can::open(settings, clock); });
  return std::make_unique<PortedOdometry<WheelsOnCan>>(kTalks, opened(std::move(port), "can", wait), *robot.can);
}

class BrickOdometry final : public OdometryDevice {
 public:
  BrickOdometry(std::shared_ptr<BrickStation> brick, const nxt::TachoOptions& options)
      : brick_(std::move(brick)), tacho_(brick_->conversation(), options) {}

  base::Result<sensor::OdometrySample> poll(base::Time now) override {
    brick_->poll(now);
    return tacho_.poll(now);
  }
  [[nodiscard]] sensor::LinkState link() const override {
    return brick_->port().connected() ? tacho_.link() : sensor::LinkState::kAbsent;
  }
  void tend(base::Time now) override { brick_->port().tend(now); }
  void watch(linux::WaitSet& set) const override { set.add_readable(brick_->port().descriptor()); }
  [[nodiscard]] std::string problem() const override { return brick_->port().problem(); }
  [[nodiscard]] base::Duration patience() const override { return patience_with(brick_->port(), kBrickAsked); }

 private:
  std::shared_ptr<BrickStation> brick_;
  nxt::TachoOdometry tacho_;
};

Odometry open_tacho(const DeviceSpec& spec, const RobotFile& robot, const std::shared_ptr<BrickStation>& brick) {
  nxt::TachoOptions options;
  options.left_port = static_cast<std::uint8_t>(spec.option("left", "B").front() - 'A');
  options.right_port = static_cast<std::uint8_t>(spec.option("right", "C").front() - 'A');
  if (options.left_port == options.right_port) {
    throw DeviceFailure{true, spec.where() + ": left and right are the same motor; give left= and right="};
  }
  options.wheels = robot.wheels.over(options.wheels);
  return std::make_unique<BrickOdometry>(brick, options);
}

}  // namespace

std::shared_ptr<BrickStation> open_brick(const DeviceSpec& spec, bool wait) {
  if (spec.kind != DeviceKind::kNxt) return nullptr;
  if (spec.place.kind == PlaceKind::kUsb) return std::make_shared<UsbBrick>(open_brick_port(spec, wait));
  return std::make_shared<SerialBrick>(open_byte_port(spec, kUsualBaud, wait));
}

Odometry open_odometry(const DeviceSpec& spec, const RobotFile& robot, const std::shared_ptr<BrickStation>& brick,
                       linux::MonotonicClock clock, bool wait) {
  switch (spec.kind) {
    case DeviceKind::kCreate1:
    case DeviceKind::kCreate2: return open_create(spec, robot, wait);
    case DeviceKind::kNxt: return open_tacho(spec, robot, brick);
    case DeviceKind::kCan: return open_can(spec, robot, clock, wait);
    case DeviceKind::kRecords: return open_records(spec, wait);
    default: return std::make_unique<ConsoleOdometry>();
  }
}

}  // namespace fencepost::host
