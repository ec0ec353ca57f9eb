// $FPODO or $FPCAR lines of another controller, on a port of their own.
#include "drivers/serial/pump.hpp"
#include "firmware/config/car.hpp"
#include "host/devices/options.hpp"
#include "host/devices/ported.hpp"
#include "host/live/record_sessions.hpp"

namespace fencepost::devices {

Rows records();

namespace {

constexpr std::uint32_t kRecordsBaud = 115'200;

std::unique_ptr<host::OdometryDevice> open_records(const Opening& opening) {
  config::Settings settings;
  for (const auto& [key, value] : opening.robot.settings) static_cast<void>(settings.set(key, value));  // checked
  const bool own = opening.spec.option("stamp") == "own";
  return odometry_on_line<serial::Pump<host::BytePort, host::RecordsSession>>(
      opening,
      host::RecordsConfig(own ? host::RecordStamp::kOwn : host::RecordStamp::kArrival, config::car_of(settings)));
}

}  // namespace

Rows records() {
  return {
      {.name = "records",
       .about = "`$FPODO` or `$FPCAR` lines of another controller",
       .role = Role::kOdometry,
       .live =
           Live{.places = {PlaceKind::kTty, PlaceKind::kTcp},
                .options = {baud(kRecordsBaud),
                            {"stamp", Words{{"arrival", "own"}}, "arrival", "our clock, or theirs if it is ours"}},
                .unready = "what comes is no $FPODO: check the baud and the other end. In the robot file's settings "
                           "$FPCAR needs car.counts, without a yaw rate also car.wheelbase",
                .driver = OdometryDriver{open_records}},
       .emulated =
           Emulated{.tells = "lines without time, as a robot's own controller prints them",
                    .options = {line_baud(kRecordsBaud)},
                    .describe = emulate::describe_text,
                    .make = [](const DeviceSpec&, const emulate::Colours&) { return emulate::make_records_model(); }}}};
}

}  // namespace fencepost::devices
