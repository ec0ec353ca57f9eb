// Newton Labs Cognachrome.
#include "drivers/cognachrome/cognachrome.hpp"

#include "host/devices/options.hpp"
#include "host/devices/ported.hpp"
#include "host/emulate/models/cognachrome.hpp"

namespace fencepost::devices {

Rows cognachrome();

namespace {

using enum PlaceKind;
using emulate::Cognachrome;

constexpr std::uint32_t kCognachromeBaud = 38'400;

Option format() {
  return {"format", Words{{"binary", "hex"}}, "binary", "binary: installed by itself; hex: as TeamBots has it"};
}

bool is_hex(const DeviceSpec& spec) { return spec.option("format") == "hex"; }

std::unique_ptr<host::CameraDevice> open_cognachrome(const Opening& opening) {
  const cognachrome::Config config{is_hex(opening.spec) ? &cognachrome::kHex : &cognachrome::kBinary};
  return camera_on_line<cognachrome::Camera<host::BytePort>>(opening, config);
}

std::unique_ptr<emulate::DeviceModel> make_cognachrome(const DeviceSpec& spec, const emulate::Colours& /*colours*/) {
  const auto preset = is_hex(spec) ? Cognachrome::Preset::kTeamBots : Cognachrome::Preset::kVision;
  return std::make_unique<Cognachrome>(preset, spec.number("baud"));
}

}  // namespace

Rows cognachrome() {
  return {
      {.name = "cognachrome",
       .about = "Newton Labs Cognachrome; its lens is a guess: calibrate",
       .role = Role::kCamera,
       .live = Live{.places = {kTty, kTcp},
                    .options = {baud(kCognachromeBaud), format()},
                    .unready = "it does not track: train its channels, and tell its monitor `baud 38400` on stream 0",
                    .driver = CameraDriver{open_cognachrome,
                                           [](const DeviceSpec&) -> std::optional<sensor::CameraIntrinsics> {
                                             return cognachrome::kProfile;
                                           },
                                           "assumed: any video lens fits it, none is named"}},
       .emulated = Emulated{.tells = "centroid and pixels, no box",
                            .options = {line_baud(kCognachromeBaud), format()},
                            .describe = emulate::describe_cognachrome,
                            .make = make_cognachrome,
                            .image = image_of(cognachrome::kProfile, {.first_signature = 1, .last_signature = 3}, 60),
                            .asked = true},
       .images = {"cognachrome"}}};
}

}  // namespace fencepost::devices
