#include <cmath>
#include <numbers>

#include "host/scene/read_scene.hpp"

namespace fencepost::host {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kMaxPitch = 0.7;  // rad; steeper, and upper rows look backwards

sensor::Text read_label(const JsonNode& node) {
  const std::string text = node.text();
  if (text.size() > sensor::kMaxText) {
    node.fail("has " + std::to_string(text.size()) + " characters", "use at most 32");
  }
  return sensor::Text(text);
}

sensor::CameraMount read_mount(const JsonNode& node) {
  node.expect_keys({"x", "y", "z", "yaw", "pitch"});
  sensor::CameraMount mount;
  mount.x = base::Metres::nearest(node.number_or("x", 0, -10, 10, "m"));
  mount.y = base::Metres::nearest(node.number_or("y", 0, -10, 10, "m"));
  mount.z = base::Metres::nearest(node.number_or("z", 0, 0, 10, "m"));
  mount.yaw = base::Radians::nearest(node.number_or("yaw", 0, -kTurn, kTurn, "rad"));
  const auto pitch = node.find("pitch");
  if (!pitch) {
    mount.pitch = base::Radians{0};
  } else if (!pitch->is_null()) {
    mount.pitch = base::Radians::nearest(pitch->number(-kMaxPitch, kMaxPitch, "rad"));
  }
  return mount;
}

std::uint16_t read_side(const JsonNode& node) {
  constexpr std::int64_t kLargest = 32'767;  // the stream's pixel range
  return static_cast<std::uint16_t>(node.integer(2, kLargest));
}

// A round thing's diameter, or the sides of a box: the mean width of its footprint is the outline over pi.
std::uint16_t read_width(const JsonNode& node) {
  constexpr double kMin = 0.005;  // m
  constexpr double kMax = 1;
  const auto millimetres = [](double metres) { return static_cast<std::uint16_t>(std::lround(1e3 * metres)); };
  if (!node.is_array()) return millimetres(node.number(kMin, kMax, "m"));
  if (node.size(2, "lengths") > 2) node.fail("has more than two lengths", "give the diameter or [length, width]");
  const double a = node.at(std::size_t{0}).number(kMin, kMax, "m");
  const double b = node.at(std::size_t{1}).number(kMin, kMax, "m");
  return millimetres(2 * (a + b) / std::numbers::pi);
}

constexpr int kMaxPad = 100;  // px, as the record has it

}  // namespace

sensor::Lens read_lens(const JsonNode& node) {
  const std::string text = node.text();
  for (const sensor::Lens lens : {sensor::Lens::kPinhole, sensor::Lens::kEquidistant}) {
    if (text == sensor::name(lens)) return lens;
  }
  node.fail("\"" + text + "\" is no lens", "write \"pinhole\", or \"equidistant\" for a fisheye");
}

void read_camera(const JsonNode& node, Scene& scene) {
  node.expect_keys(
      {"model", "width", "height", "fx", "fy", "cx", "cy", "k1", "lens", "mount", "latency", "rate", "max_blobs"});
  constexpr double kLongestFocus = 32'767;  // the stream's range
  sensor::CameraIntrinsics& camera = scene.camera;
  const auto model = node.find("model");
  camera.model = model ? read_label(*model) : sensor::Text("camera");
  camera.width = read_side(node.at("width"));
  camera.height = read_side(node.at("height"));
  camera.fx = base::Pixels2::nearest(node.at("fx").number(1, kLongestFocus, "px"));
  camera.fy = base::Pixels2::nearest(node.at("fy").number(1, kLongestFocus, "px"));
  camera.cx = base::Pixels2::nearest(node.at("cx").number(-32'768, 32'767, "px"));
  camera.cy = base::Pixels2::nearest(node.at("cy").number(-32'768, 32'767, "px"));
  camera.k1 = base::Ratio4::nearest(node.number_or("k1", 0, -1, 1, ""));
  if (const auto lens = node.find("lens")) camera.lens = read_lens(*lens);
  if (const auto mount = node.find("mount")) {
    camera.mount = read_mount(*mount);
  } else {
    camera.mount.pitch = base::Radians{0};
  }
  camera.latency = base::Duration::nearest(node.number_or("latency", 0, 0, 10, "s"));
  const auto rate = node.find("rate");
  if (rate) scene.rate = rate->number(0.01, 1000, "frames/s");
  const auto blobs = node.find("max_blobs");
  if (blobs) scene.max_blobs = static_cast<int>(blobs->integer(1, sensor::kMaxBlobs));
}

SceneSignature read_signature(const JsonNode& node) {
  node.expect_keys({"id", "name", "rgb", "size", "pad"});
  SceneSignature signature;
  signature.id = static_cast<std::uint8_t>(node.at("id").integer(0, 255));
  const auto name = node.find("name");
  signature.name = name ? std::string(read_label(*name).view()) : "signature " + std::to_string(signature.id);
  const JsonNode rgb = node.at("rgb");
  const std::string digits = rgb.text();
  if (digits.size() != 6 || digits.find_first_not_of("0123456789abcdefABCDEF") != std::string::npos) {
    rgb.fail("\"" + digits + "\" is not a colour", "write six hex digits RRGGBB, for example \"d02020\"");
  }
  const auto channel = [&](std::size_t at) {
    return static_cast<std::uint8_t>(std::stoul(digits.substr(at, 2), nullptr, 16));
  };
  signature.rgb = {channel(0), channel(2), channel(4)};
  if (const auto size = node.find("size")) signature.width = read_width(*size);
  if (const auto pad = node.find("pad")) signature.pad = static_cast<std::int8_t>(pad->integer(-kMaxPad, kMaxPad));
  return signature;
}

}  // namespace fencepost::host
