// Cameras whose own programs print $FPFRM lines: the scripts in host/share/examples, or anybody's.
#include <cmath>
#include <numbers>

#include "drivers/serial/pump.hpp"
#include "hal/sensor/sources.hpp"
#include "host/devices/options.hpp"
#include "host/devices/ported.hpp"
#include "host/emulate/models/frames.hpp"
#include "host/live/record_sessions.hpp"

namespace fencepost::devices {

Rows frames();

namespace {

using FramesCamera = serial::Pump<host::BytePort, host::FramesSession>;
static_assert(sensor::BlobCamera<FramesCamera>);

constexpr std::uint32_t kFramesBaud = 115'200;
// Columns of pictures as the scripts take them; 4 : 3.
constexpr std::uint16_t kColumns = 320;
constexpr std::uint16_t kCbcColumns = 160;  // of the CBC
// Standard lenses, in degrees across.
constexpr double kOpenMvLens = 70.8;  // its documentation, of the 2.8 mm lens
constexpr double kMaixCamLens = 60;   // no source: assumed
constexpr double kVexAiVision = 74;   // as its users quote it
constexpr double kCbcLens = 45;       // no source, and any webcam: assumed, as for the XBC

/// Two frames of 30 /s as latency: assumed.
sensor::CameraIntrinsics profile_of(const char* model, double degrees, std::uint16_t columns = kColumns) {
  const double focal = columns / 2.0 / std::tan(degrees / 2 * std::numbers::pi / 180);
  sensor::CameraIntrinsics profile;
  profile.model = model;
  profile.width = columns;
  profile.height = static_cast<std::uint16_t>(columns / 4 * 3);
  profile.fx = profile.fy = base::Pixels2::nearest(focal);
  profile.cx = base::Pixels2::nearest((profile.width - 1) / 2.0);
  profile.cy = base::Pixels2::nearest((profile.height - 1) / 2.0);
  profile.latency = base::milliseconds(67);
  return profile;
}

std::unique_ptr<host::CameraDevice> open_frames(const Opening& opening) {
  return camera_on_line<FramesCamera>(opening, host::FramesConfig{});
}

std::optional<sensor::CameraIntrinsics> openmv(const DeviceSpec& /*spec*/) { return profile_of("openmv", kOpenMvLens); }
std::optional<sensor::CameraIntrinsics> maixcam(const DeviceSpec& /*spec*/) {
  return profile_of("maixcam", kMaixCamLens);
}
std::optional<sensor::CameraIntrinsics> vex(const DeviceSpec& /*spec*/) { return profile_of("vex_ai", kVexAiVision); }
std::optional<sensor::CameraIntrinsics> cbc(const DeviceSpec& /*spec*/) {
  return profile_of("cbc", kCbcLens, kCbcColumns);
}

template <bool Areas>
std::unique_ptr<emulate::DeviceModel> make(const DeviceSpec& /*spec*/, const emulate::Colours& /*colours*/) {
  return std::make_unique<emulate::FramePrinter>(Areas);
}

Row row(const char* name, const char* about, decltype(openmv)* profile, const char* lens, const char* others = "") {
  return {.name = name,
          .about = about,
          .role = Role::kCamera,
          .live = Live{.places = {PlaceKind::kTty, PlaceKind::kTcp},
                       .options = {baud(kFramesBaud)},
                       .unready = "what comes is no $FPFRM: start the script on it, and check the baud",
                       .driver = CameraDriver{open_frames, profile, lens}},
          .emulated = std::nullopt,
          .tried = {{.others = others}}};
}

Row emulated(Row row, const char* tells, decltype(make<true>)* model, const Blobs& blobs) {
  const auto& camera = std::get<CameraDriver>((*row.live)->driver);
  row.emulated = Emulated{.tells = tells,
                          .options = {line_baud(kFramesBaud)},
                          .describe = emulate::describe_text,
                          .make = model,
                          .image = image_of(*(*camera.profile)({}), blobs, 30)};
  return row;
}

}  // namespace

Rows frames() {
  return {
      emulated(row("openmv", "OpenMV, with examples/openmv_frames.py running on it; calibrate", openmv,
                   "maker: 70.8 degrees of the delivered 2.8 mm lens, its documentation; others can be screwed on",
                   "its script with OpenMV 4.8.1's blobs, on MicroPython"),
               "lines by a clock of its own", make<true>, {.first_signature = 1, .last_signature = 16}),
      emulated(row("maixcam", "MaixCAM, with examples/maixcam_frames.py running on it; calibrate", maixcam,
                   "assumed: no source tells an angle"),
               "lines by a clock of its own", make<true>, {.first_signature = 1, .last_signature = 16}),
      emulated(row("vex", "VEX AI Vision, with examples/vex_frames.py running on the Brain; calibrate", vex,
                   "published: 74 degrees, as its users quote it; the maker tells 320 by 240 pixels only"),
               "lines by a clock of its own; no areas", make<false>,
               {.of_signature = 8, .first_signature = 1, .last_signature = 7}),
      emulated(
          row("cbc", "CBC, with examples/cbc_frames.c running on it; calibrate", cbc, "assumed: any webcam fits it"),
          "lines by a clock of its own", make<true>, {.of_signature = 10, .first_signature = 1, .last_signature = 4})};
}

}  // namespace fencepost::devices
