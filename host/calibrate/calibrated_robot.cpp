#include "host/calibrate/calibrated_robot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "host/live/robot_file.hpp"

namespace fencepost::host {
namespace {

using Json = nlohmann::ordered_json;

/// To the tenth of a micrometre: counts are of fractions of a millimetre.
double fine(double value) { return std::round(value * 1e10) / 1e10; }

void put_camera(const sensor::CameraIntrinsics& camera, Json& robot) {
  Json& out = robot["camera"];
  out["model"] = std::string(camera.model.view());
  out["width"] = camera.width;
  out["height"] = camera.height;
  out["fx"] = camera.fx.to_double();
  out["fy"] = camera.fy.to_double();
  out["cx"] = camera.cx.to_double();
  out["cy"] = camera.cy.to_double();
  out["k1"] = camera.k1.to_double();
  Json mount = {{"x", camera.mount.x.to_double()},
                {"y", camera.mount.y.to_double()},
                {"z", camera.mount.z.to_double()},
                {"yaw", camera.mount.yaw.to_double()}};
  mount["pitch"] = camera.mount.pitch ? Json(camera.mount.pitch->to_double()) : Json(nullptr);
  out["mount"] = std::move(mount);
  out["latency"] = camera.latency.to_double();
}

/// d = (left + right) / 2 and turn = (right - left) / track. So the turn scale is the steps' scale over the track's. A
/// metre turns the robot by the difference of the two steps over the track.
void correct_wheels(const WheelCorrection& found, Json& wheels) {
  const double step = 1 + found.step;
  if (!wheels.contains("track")) {
    for (const char* key : {"metres_per_tick", "left_metres_per_tick", "right_metres_per_tick"}) {
      if (wheels.contains(key)) wheels[key] = fine(wheels[key].get<double>() * step);
    }
    return;
  }
  const double track = wheels["track"].get<double>() * step / (1 + found.turn);
  wheels["track"] = fine(track);
  const double uneven = found.curve * track / (2 * step);
  const auto correct = [&](const char* key, double factor) {
    const char* both = "metres_per_tick";
    if (wheels.contains(key)) {
      wheels[key] = fine(wheels[key].get<double>() * step * factor);
    } else if (wheels.contains(both)) {
      wheels[key] = fine(wheels[both].get<double>() * step * factor);
    }
  };
  correct("left_metres_per_tick", 1 - uneven);
  correct("right_metres_per_tick", 1 + uneven);
  wheels.erase("metres_per_tick");
}

Json signatures_json(const std::vector<record::Signature>& signatures) {
  Json out = Json::array();
  for (const record::Signature& signature : signatures) {
    out.push_back(
        {{"id", signature.signature},
         {"name", std::string(signature.name.view())},
         {"rgb", fmt::format("{:02x}{:02x}{:02x}", signature.rgb.red, signature.rgb.green, signature.rgb.blue)}});
    if (signature.width > 0) out.back()["size"] = signature.width / 1e3;
    if (signature.pad != 0) out.back()["pad"] = signature.pad;
  }
  return out;
}

/// A signature that the robot has keeps all else.
void put_pads(const Calibration& found, Json& robot) {
  for (const FoundPad& pad : found.pads) {
    const auto known = std::ranges::find(found.signatures, pad.signature, &record::Signature::signature);
    if (known == found.signatures.end()) continue;
    Json& list = robot["signatures"];
    const auto own = std::ranges::find_if(list, [&](const Json& entry) { return entry.at("id") == pad.signature; });
    if (own == list.end()) {
      list.push_back(signatures_json({*known}).at(0));
    } else {
      (*own)["pad"] = known->pad;
    }
  }
}

}  // namespace

base::Result<std::string, RobotProblem> calibrated_robot(const Calibration& calibration, const std::string& base,
                                                         const std::string& base_name) {
  Json robot = Json::object();
  if (!base.empty()) {
    const auto checked = parse_robot(base, base_name);
    if (!checked) return RobotProblem{checked.error()};
    robot = Json::parse(base);
  }
  put_camera(calibration.found, robot);
  if (!robot.contains("signatures") && !calibration.signatures.empty()) {
    robot["signatures"] = signatures_json(calibration.signatures);
  }
  put_pads(calibration, robot);
  if (robot.contains("wheels")) correct_wheels(calibration.wheels, robot["wheels"]);
  return robot.dump(2) + "\n";
}

}  // namespace fencepost::host
