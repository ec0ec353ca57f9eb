// CMUcam 1, 2, 3 and 4.
#include "drivers/cmucam/cmucam.hpp"
#include "host/devices/options.hpp"
#include "host/devices/ported.hpp"
#include "host/emulate/models/camera_adapters.hpp"

namespace fencepost::devices {

Rows cmucam();

namespace {

using cmucam::Dialect;
using emulate::CmuCamModel;

constexpr std::uint32_t kCmucamBaud = 115'200;
constexpr std::uint32_t kCmucam4Baud = 19'200;
constexpr double kRate = 17;
constexpr double kRate4 = 30;

bool high(const DeviceSpec& spec) { return spec.option("resolution") == "high"; }

const Dialect& dialect1(const DeviceSpec& /*spec*/) { return cmucam::kCmuCam1; }
const Dialect& dialect2(const DeviceSpec& spec) {
  if (spec.option("imager") == "ov7620") return cmucam::kCmuCam2Ov7620;
  return high(spec) ? cmucam::kCmuCam2High : cmucam::kCmuCam2;
}
const Dialect& dialect3(const DeviceSpec& spec) { return high(spec) ? cmucam::kCmuCam3High : cmucam::kCmuCam3; }
const Dialect& dialect4(const DeviceSpec& /*spec*/) { return cmucam::kCmuCam4; }

template <const Dialect& (*DialectOf)(const DeviceSpec&)>
std::unique_ptr<host::CameraDevice> open_cmucam(const Opening& opening) {
  if (opening.robot.windows.empty()) {
    throw host::DeviceFailure{true, opening.spec.where() +
                                        " tracks no colour yet: name them in a --robot file, for example "
                                        "{\"signatures\": [{\"id\": 1, \"name\": \"red\", \"rgb\": \"d02020\"}]}"};
  }
  cmucam::Config config;
  config.dialect = &DialectOf(opening.spec);
  for (const cmucam::ColourWindow& window : opening.robot.windows) static_cast<void>(config.windows.push_back(window));
  config.settle = base::milliseconds(1'000 * static_cast<std::int64_t>(opening.spec.number("settle")));
  return camera_on_line<cmucam::CmuCam<host::BytePort>>(opening, config);
}

template <const Dialect& (*DialectOf)(const DeviceSpec&)>
std::optional<sensor::CameraIntrinsics> cmucam_profile(const DeviceSpec& spec) {
  return cmucam::nominal_intrinsics(DialectOf(spec), {});
}

template <CmuCamModel Model>
std::unique_ptr<emulate::DeviceModel> make(const DeviceSpec& /*spec*/, const emulate::Colours& colours) {
  return emulate::make_cmucam_model(Model, colours);
}

template <const Dialect& (*DialectOf)(const DeviceSpec&), CmuCamModel Model>
Row row(int number, const Dialect& usual, std::uint32_t delivered_baud, double rate,
        const std::vector<Option>& own_options, const char* others) {
  std::vector<Option> options = {baud(delivered_baud), {"settle", Whole{0, 60}, "5", "s for white balance and gain"}};
  options.insert(options.end(), own_options.begin(), own_options.end());
  const std::string name = fmt::format("cmucam{}", number);
  return {.name = name,
          .about = fmt::format("CMUcam{}", number),
          .role = Role::kCamera,
          .live = Live{.places = {PlaceKind::kTty, PlaceKind::kTcp},
                       .options = options,
                       .unready = "it is being set up, or of another kind",
                       .driver =
                           CameraDriver{
                               open_cmucam<DialectOf>, cmucam_profile<DialectOf>,
                               number == 2
                                   ? "published: 44.1 by 33.7 degrees of the FRC kit's lens; teams measured 46.6 to 50"
                                   : "assumed: that of the CMUcam2"}},
          .emulated = Emulated{.tells = "one box over all that lies inside the colour window",
                               .options = {line_baud(delivered_baud)},
                               .describe = emulate::describe_text,
                               .make = make<Model>,
                               .image = image_of(cmucam::nominal_intrinsics(usual, {}), {}, rate)},
          .images = {name},
          .tried = {{.others = others}}};
}

}  // namespace

Rows cmucam() {
  const Option resolution = {"resolution", Words{{"low", "high"}}, "low"};
  const Option imager = {"imager", Words{{"ov6620", "ov7620"}}, "ov6620"};
  return {row<dialect1, CmuCamModel::kOne>(1, cmucam::kCmuCam1, kCmucamBaud, kRate, {}, "cmucam-viewer"),
          row<dialect2, CmuCamModel::kTwo>(2, cmucam::kCmuCam2, kCmucamBaud, kRate, {resolution, imager}, "CMUcam2PY"),
          row<dialect3, CmuCamModel::kThree>(3, cmucam::kCmuCam3, kCmucamBaud, kRate, {resolution},
                                             "firmware cmucam2 of the CMUcam3, compiled for a PC"),
          row<dialect4, CmuCamModel::kFour>(4, cmucam::kCmuCam4, kCmucam4Baud, kRate4, {}, "CMUCam4.c of EECS 373")};
}

}  // namespace fencepost::devices
