#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/scene/camera_numbers.hpp"
#include "host/scene/read_scene.hpp"
#include "host/scene/rgb.hpp"

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
  if (!pitch || !pitch->is_null()) {
    mount.pitch = base::Radians::nearest(pitch ? pitch->number(-kMaxPitch, kMaxPitch, "rad") : 0);
  }
  return mount;
}

sensor::Lens read_lens(const JsonNode& node) {
  const std::string text = node.text();
  for (const sensor::Lens lens : {sensor::Lens::kPinhole, sensor::Lens::kEquidistant}) {
    if (text == sensor::name(lens)) return lens;
  }
  node.fail("\"" + text + "\" is no lens", "write \"pinhole\", or \"equidistant\" for a fisheye");
}

template <class Quantity>
void read_quantity(const JsonNode& node, std::string_view key, double low, double high, std::string_view unit,
                   std::optional<Quantity>& into) {
  if (const auto found = node.find(key)) into = Quantity::nearest(found->number(low, high, unit));
}

std::optional<std::uint16_t> read_side(const JsonNode& node, std::string_view key) {
  constexpr std::int64_t kLargest = 32'767;  // the stream's pixel range
  const auto found = node.find(key);
  return found ? std::optional(static_cast<std::uint16_t>(found->integer(2, kLargest))) : std::nullopt;
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

SceneSignature read_signature(const JsonNode& node) {
  node.expect_keys({"id", "name", "rgb", "size", "pad"});
  SceneSignature signature;
  signature.id = static_cast<std::uint8_t>(node.at("id").integer(0, 255));
  const auto name = node.find("name");
  signature.name = name ? std::string(read_label(*name).view()) : "signature " + std::to_string(signature.id);
  const JsonNode rgb = node.at("rgb");
  const std::string digits = rgb.text();
  const auto colour = rgb_of(digits);
  if (!colour) rgb.fail("\"" + digits + "\" is not a colour", "write six hex digits RRGGBB, for example \"d02020\"");
  signature.rgb = *colour;
  if (const auto size = node.find("size")) signature.width = read_width(*size);
  if (const auto pad = node.find("pad")) signature.pad = static_cast<std::int8_t>(pad->integer(-kMaxPad, kMaxPad));
  return signature;
}

}  // namespace

CameraNumbers read_camera_numbers(const JsonNode& node) {
  node.expect_keys(
      {"model", "width", "height", "fx", "fy", "cx", "cy", "k1", "lens", "mount", "latency", "rate", "max_blobs"});
  constexpr double kLongestFocus = 32'767;  // the stream's range
  CameraNumbers camera;
  if (const auto model = node.find("model")) camera.model = read_label(*model);
  camera.width = read_side(node, "width");
  camera.height = read_side(node, "height");
  read_quantity(node, "fx", 1, kLongestFocus, "px", camera.fx);
  read_quantity(node, "fy", 1, kLongestFocus, "px", camera.fy);
  read_quantity(node, "cx", -32'768, 32'767, "px", camera.cx);
  read_quantity(node, "cy", -32'768, 32'767, "px", camera.cy);
  read_quantity(node, "k1", -1, 1, "", camera.k1);
  if (const auto lens = node.find("lens")) camera.lens = read_lens(*lens);
  if (const auto mount = node.find("mount")) camera.mount = read_mount(*mount);
  read_quantity(node, "latency", 0, 10, "s", camera.latency);
  return camera;
}

sensor::CameraIntrinsics CameraNumbers::over(sensor::CameraIntrinsics profile) const {
  profile.model = model.value_or(profile.model);
  profile.width = width.value_or(profile.width);
  profile.height = height.value_or(profile.height);
  profile.fx = fx.value_or(profile.fx);
  profile.fy = fy.value_or(profile.fy);
  profile.cx = cx.value_or(profile.cx);
  profile.cy = cy.value_or(profile.cy);
  profile.k1 = k1.value_or(profile.k1);
  profile.lens = lens.value_or(profile.lens);
  profile.mount = mount.value_or(profile.mount);
  profile.latency = latency.value_or(profile.latency);
  return profile;
}

void read_camera(const JsonNode& node, Scene& scene) {
  scene.camera.model = "camera";
  scene.camera.mount.pitch = base::Radians{0};
  scene.camera = read_camera_numbers(node).over(scene.camera);
  for (const char* key : {"width", "height", "fx", "fy", "cx", "cy"}) static_cast<void>(node.at(key));
  if (const auto rate = node.find("rate")) scene.rate = rate->number(0.01, 1000, "frames/s");
  if (const auto blobs = node.find("max_blobs")) {
    scene.max_blobs = static_cast<int>(blobs->integer(1, sensor::kMaxBlobs));
  }
}

std::vector<SceneSignature> read_signatures(const JsonNode& node, std::size_t least) {
  std::vector<SceneSignature> signatures;
  for (std::size_t i = 0; i < node.size(least, "signatures"); ++i) {
    const SceneSignature read = read_signature(node.at(i));
    const auto is_it = [&](const SceneSignature& other) { return other.id == read.id; };
    if (std::any_of(signatures.begin(), signatures.end(), is_it)) {
      node.at(i).at("id").fail("signature " + std::to_string(read.id) + " is there twice",
                               "give each signature an id of its own");
    }
    signatures.push_back(read);
  }
  return signatures;
}

}  // namespace fencepost::host
