// iRobot Create 1 and 2.
#include "drivers/create/create.hpp"
#include "drivers/odometry/wheel_base.hpp"
#include "host/devices/options.hpp"
#include "host/devices/ported.hpp"

namespace fencepost::devices {

Rows create();

namespace {

using emulate::CreateModel;

constexpr std::uint32_t kCreate1Baud = 57'600;
constexpr std::uint32_t kCreate2Baud = 115'200;

template <create::Model Model>
constexpr odometry::WheelBase kWheels =
    Model == create::Model::kCreate1 ? odometry::kCreate1Wheels : odometry::kCreate2Wheels;
template <create::Model Model>
constexpr emulate::WheelShape kShape{metres(kWheels<Model>.left_pm_per_count), metres(kWheels<Model>.track_pm)};

using Wheels = Ported<create::Create<host::BytePort>>;

/// With `drive` it goes straight on while the robot may drive.
class CreateDevice final : public host::PortedDevice<host::OdometryDevice, Wheels> {
 public:
  CreateDevice(const Opening& opening, const create::Config& config, std::int16_t velocity)
      : PortedDevice(kTalks, open_line(opening), config) {
    if (velocity != 0) stack_.driver.session().drive({velocity, create::Motion::kStraight});
  }
  base::Result<sensor::OdometrySample> poll(base::Time now) override { return stack_.driver.poll(now); }
  void allow_motion(std::int16_t most, base::Time now) override {
    const bool allowed = most > 0;
    stack_.driver.session().allow_motion(allowed, most);
    if (std::exchange(allowed_, allowed) && !allowed) stack_.driver.push(now);
  }
  void stand(base::Time now) override {
    stack_.driver.session().stand();
    stack_.driver.push(now);
  }

 private:
  bool allowed_ = false;
};

create::Mode mode_of(const std::string& word, bool drives) {
  if (word == "full") return create::Mode::kFull;
  return word == "safe" || drives ? create::Mode::kSafe : create::Mode::kPassive;
}

template <create::Model Model>
std::unique_ptr<host::OdometryDevice> open_create(const Opening& opening) {
  const auto velocity = static_cast<std::int16_t>(opening.spec.number("drive"));
  create::Config config;
  config.model = Model;
  config.wheels = opening.robot.wheels.over(kWheels<Model>);
  config.mode = mode_of(opening.spec.option("mode"), velocity != 0);
  return std::make_unique<CreateDevice>(opening, config, velocity);
}

template <CreateModel Model>
std::unique_ptr<emulate::DeviceModel> make(const DeviceSpec& spec, const emulate::Colours& /*colours*/) {
  return emulate::make_create_model(Model, {spec.real("tick"), spec.real("track")});
}

template <create::Model Model, CreateModel Emulation>
Row row(const char* name, const char* about, std::uint32_t delivered_baud, const char* tells, const char* others) {
  return {.name = name,
          .about = about,
          .role = Role::kOdometry,
          .live = Live{.places = {PlaceKind::kTty, PlaceKind::kTcp},
                       .options = {baud(delivered_baud),
                                   {"mode", Words{{"passive", "safe", "full"}}, "passive",
                                    "of the robot, which others may drive in safe and full"},
                                   {"drive", Whole{1, 500, true}, "0",
                                    "mm/s straight on, in mode safe, while the robot may drive"}},
                       .unready = "what comes is no sensor stream: check the baud and the model",
                       .driver = OdometryDriver{open_create<Model>}},
          .emulated = Emulated{.tells = tells,
                               .options = wheel_options(delivered_baud, kShape<Model>),
                               .describe = emulate::describe_create,
                               .make = make<Emulation>,
                               .wheels = kShape<Model>},
          .images = {name},
          .tried = {{.others = others}}};
}

}  // namespace

Rows create() {
  return {row<create::Model::kCreate1, CreateModel::kOne>(
              "create1", "iRobot Create", kCreate1Baud, "requested speeds, whole mm and degrees since the last reading",
              "libcreate"),
          row<create::Model::kCreate2, CreateModel::kTwo>(
              "create2", "Create 2, Roomba 600", kCreate2Baud, "counts",
              "counts that others recorded; libcreate, pycreate2, BreezyCreate2, RoombaCI")};
}

}  // namespace fencepost::devices
