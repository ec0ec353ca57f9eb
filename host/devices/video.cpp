// Cameras that deliver pictures, and films of them: the segmenter makes boxes of both.
#include "host/devices/video.hpp"

#include <fmt/format.h>

#include "drivers/segmenter/camera.hpp"
#include "host/devices/options.hpp"
#include "host/devices/ported.hpp"
#include "host/text/device_word.hpp"
#include "host/video/picture_port.hpp"

namespace fencepost::devices {

Rows video();

namespace {

using Segmented = Ported<segmenter::Camera<host::PicturePort>, host::PicturePort>;
static_assert(sensor::BlobCamera<segmenter::Camera<host::PicturePort>>);

constexpr const char* kWebcamAngle = "assumed: no webcam tells an angle";
constexpr const char* kDamagedPictures =
    "its pictures cannot be decoded: try format=yuyv, another cable, or a port of its own";

struct Size {
  std::uint16_t width = segmenter::kWidth;
  std::uint16_t height = segmenter::kHeight;
};

Size size_in(const std::string& option) {
  const std::size_t between = option.find('x');
  return {static_cast<std::uint16_t>(host::whole_number(option.substr(0, between)).value_or(0)),
          static_cast<std::uint16_t>(host::whole_number(option.substr(between + 1)).value_or(0))};
}

sensor::CameraIntrinsics profile_of(const Size& size) { return segmenter::profile_of(size.width, size.height); }

std::optional<sensor::CameraIntrinsics> webcam_profile(const DeviceSpec& spec) {
  return profile_of(size_in(spec.option("size")));
}

Size size_of(const host::Film& film) { return {film.width(), film.height()}; }

std::optional<sensor::CameraIntrinsics> film_profile(const DeviceSpec& spec) {
  if (spec.place.kind != PlaceKind::kFilm) return profile_of({});
  linux::Opened<host::Film> film = host::Film::open(spec.place.name);
  return profile_of(film ? size_of(*film) : Size{});
}

[[noreturn]] void refuse(const DeviceSpec& spec, const std::string& what) {
  throw host::DeviceFailure{true, spec.where() + ": " + what};
}

segmenter::Config config_of(const Opening& opening, const Size& size) {
  const host::RobotFile& robot = opening.robot;
  if (robot.colours.empty()) {
    refuse(opening.spec,
           "no colour is trained; write a file by 'fencepost train' and give it as --colours FILE, or put its "
           "\"colours\" into the --robot file");
  }
  const std::uint16_t width = robot.camera.width.value_or(size.width);
  const std::uint16_t height = robot.camera.height.value_or(size.height);
  if (width != size.width || height != size.height) {
    refuse(opening.spec,
           fmt::format("its pictures have {} x {} px, the robot file's camera {} x {}; give the calibration of "
                       "such pictures, or let the camera take others (size=WIDTHxHEIGHT)",
                       size.width, size.height, width, height));
  }
  segmenter::Config config;
  config.ranges = robot.colours;
  config.rules = segmenter::rules_of(size.width, size.height);
  return config;
}

std::vector<linux::PictureCoding> codings_of(const DeviceSpec& spec) {
  using enum linux::PictureCoding;
  const std::string format = spec.option("format");
  const std::string missing = host::JpegDecoder::missing();
  if (format == "jpeg" && !missing.empty()) refuse(spec, missing);
  if (format == "yuyv" || !missing.empty()) return {kYuyv};
  return format == "jpeg" ? std::vector{kJpeg} : std::vector{kYuyv, kJpeg};
}

std::unique_ptr<host::CameraDevice> open_webcam(const Opening& opening) {
  const segmenter::Config config = config_of(opening, size_in(opening.spec.option("size")));
  const linux::V4l2Settings settings = webcam_settings(opening.spec);
  auto port = std::make_unique<host::WebcamPort>([settings] { return linux::V4l2::open(settings); });
  return std::make_unique<host::PortedCamera<Segmented>>(kTalks, host::opened(std::move(port), opening.port()), config);
}

std::unique_ptr<host::CameraDevice> open_film(const Opening& opening) {
  linux::Opened<host::Film> film = host::Film::open(opening.spec.place.name);
  if (!film) throw host::DeviceFailure{false, "video: " + film.problem()};
  const Size size = size_of(*film);
  if (size.width > segmenter::BlobFinder::kMaxWidth || size.height > segmenter::BlobFinder::kMaxHeight) {
    refuse(opening.spec, fmt::format("its pictures have {} x {} px, more than {} x {}; scale the film down", size.width,
                                     size.height, segmenter::BlobFinder::kMaxWidth, segmenter::BlobFinder::kMaxHeight));
  }
  const segmenter::Config config = config_of(opening, size);
  return std::make_unique<host::PortedCamera<Segmented>>(kLookedAt, std::make_unique<host::FilmPort>(std::move(*film)),
                                                         config);
}

}  // namespace

linux::V4l2Settings webcam_settings(const DeviceSpec& spec) {
  const Size size = size_in(spec.option("size"));
  return {spec.place.name, size.width, size.height, spec.number("rate"), codings_of(spec)};
}

Rows video() {
  return {
      {.name = "v4l2",
       .about = "Any webcam, or a camera module of a Raspberry Pi; colours by `fencepost train`; calibrate",
       .role = Role::kCamera,
       .live = Live{.places = {PlaceKind::kVideo},
                    .options = {{"size", Words{{"320x240", "160x120", "640x480"}}, "320x240", "of its pictures, px"},
                                {"rate", Whole{1, 240}, "30", "pictures a second, as near as it can"},
                                {"format", Words{{"any", "yuyv", "jpeg"}}, "any", "how they are sent"}},
                    .unready = kDamagedPictures,
                    .driver = CameraDriver{open_webcam, webcam_profile, kWebcamAngle}},
       .emulated = std::nullopt,
       .tried = {{PlaceKind::kVideo, "", "", "none: a stand-in for the kernel, in tests"}}},
      {.name = "video",
       .about = "A film of such a camera, played once at its own rate; colours by `fencepost train`",
       .role = Role::kCamera,
       .live = Live{.places = {PlaceKind::kFilm},
                    .options = {},
                    .unready = "a picture of it is damaged",
                    .driver = CameraDriver{open_film, film_profile, kWebcamAngle}},
       .emulated = std::nullopt,
       .tried = {{PlaceKind::kFilm, "", "", "none: rendered films"}}}};
}

}  // namespace fencepost::devices
