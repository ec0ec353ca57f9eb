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

constexpr double metres(std::int64_t picometres) { return static_cast<double>(picometres) * 1e-12; }
// Create: Open Interface specification.
constexpr emulate::WheelShape kCreateWheels{metres(odometry::kCreate2Wheels.left_pm_per_count),
                                            metres(odometry::kCreate2Wheels.track_pm)};

template <create::Model Model>
std::unique_ptr<host::OdometryDevice> open_create(const Opening& opening) {
  create::Config config;
  config.model = Model;
  config.wheels = opening.robot.wheels.over(config.wheels);
  const std::string mode = opening.spec.option("mode");
  if (mode == "safe") config.mode = create::Mode::kSafe;
  if (mode == "full") config.mode = create::Mode::kFull;
  return odometry_on_line<create::Create<host::BytePort>>(opening, config);
}

template <CreateModel Model>
std::unique_ptr<emulate::DeviceModel> make(const DeviceSpec& spec, const emulate::Colours& /*colours*/) {
  return emulate::make_create_model(Model, {spec.real("tick"), spec.real("track")});
}

template <create::Model Model, CreateModel Emulation>
Row row(const char* name, const char* about, std::uint32_t delivered_baud, const char* tells) {
  return {.name = name,
          .about = about,
          .role = Role::kOdometry,
          .live = Live{.places = {PlaceKind::kTty, PlaceKind::kTcp},
                       .options = {baud(delivered_baud), {"mode", Words{{"passive", "safe", "full"}}, "passive"}},
                       .unready = "what comes is no sensor stream: check the baud and the model",
                       .driver = OdometryDriver{open_create<Model>}},
          .emulated = Emulated{.tells = tells,
                               .options = wheel_options(delivered_baud, kCreateWheels),
                               .describe = emulate::describe_create,
                               .make = make<Emulation>,
                               .wheels = kCreateWheels},
          .images = {name}};
}

}  // namespace

Rows create() {
  return {row<create::Model::kCreate1, CreateModel::kOne>("create1", "iRobot Create", kCreate1Baud,
                                                          "whole mm and degrees since the last reading"),
          row<create::Model::kCreate2, CreateModel::kTwo>("create2", "Create 2, Roomba 600", kCreate2Baud, "counts")};
}

}  // namespace fencepost::devices
