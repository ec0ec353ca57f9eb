#include "host/calibrate/calibrated_robot.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "host/live/robot_file.hpp"
#include "host/scene/camera_numbers.hpp"

namespace fencepost::host {
namespace {

using Json = nlohmann::ordered_json;

/// To the tenth of a micrometre: counts are of fractions of a millimetre.
double fine(double value) { return std::round(value * 1e10) / 1e10; }

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

Json signature_json(const record::Signature& signature) {
  return host::signature_json(
      {signature.signature, std::string(signature.name.view()), signature.rgb, signature.width, signature.pad});
}

/// A signature that the robot has keeps all else.
void put_pads(const Calibration& found, Json& robot) {
  for (const FoundPad& pad : found.pads) {
    const auto known = std::ranges::find(found.signatures, pad.signature, &record::Signature::signature);
    if (known == found.signatures.end()) continue;
    Json& list = robot["signatures"];
    const auto own = std::ranges::find_if(list, [&](const Json& entry) { return entry.at("id") == pad.signature; });
    if (own == list.end()) {
      list.push_back(signature_json(*known));
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
  robot["camera"].update(camera_json(calibration.found));
  if (!robot.contains("signatures")) {
    for (const record::Signature& signature : calibration.signatures) {
      robot["signatures"].push_back(signature_json(signature));
    }
  }
  put_pads(calibration, robot);
  if (robot.contains("wheels")) correct_wheels(calibration.wheels, robot["wheels"]);
  return robot.dump(2) + "\n";
}

}  // namespace fencepost::host
