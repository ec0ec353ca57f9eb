#include "host/calibrate/cause_findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/calibrate/known.hpp"
#include "host/text/printable.hpp"

namespace fencepost::host {
namespace {

using doctor::Code;

constexpr double kInDegrees = 180 / std::numbers::pi;

/// As another explanation.
std::string_view words(CauseKind kind) {
  switch (kind) {
    case CauseKind::kFocal: return "the focal length";
    case CauseKind::kYaw: return "the yaw";
    case CauseKind::kPitch: return "the pitch";
    case CauseKind::kLatency: return "the latency";
    case CauseKind::kHeight: return "the mount's height";
    case CauseKind::kStep: return "the wheels' metre";
    case CauseKind::kTurn: return "the wheels' turns";
    case CauseKind::kCurve: return "unequal wheels";
    case CauseKind::kPad: return "boxes that are too wide";
    case CauseKind::kWidth: return "a width in FPSIG";
  }
  return "";
}

std::string against(const char* what, double scale, int decimals, const char* unit, const Cause& cause) {
  return fmt::format("{} is {:.{}f} +- {:.{}f} {}, and the log says {:.{}f}", what, scale * cause.found, decimals,
                     scale * cause.sigma, decimals, unit, scale * cause.configured, decimals);
}

std::string what_it_is(const Cause& cause, const std::string& name) {
  switch (cause.kind) {
    case CauseKind::kFocal: return against("the focal length", 1, 1, "px", cause);
    case CauseKind::kYaw: return against("the camera's yaw", kInDegrees, 2, "deg", cause);
    case CauseKind::kPitch: return against("the camera's pitch", kInDegrees, 2, "deg", cause);
    case CauseKind::kLatency: return against("the frames' latency", 1000, 0, "ms", cause);
    case CauseKind::kHeight: return against("the camera's height", 1000, 0, "mm", cause);
    case CauseKind::kWidth: return against(("the width of " + name).c_str(), 1000, 0, "mm", cause);
    case CauseKind::kStep:
      return fmt::format("the odometry slips: true ways are {:+.1f} +- {:.1f} % of what it reports", 100 * cause.found,
                         100 * cause.sigma);
    case CauseKind::kTurn:
      return fmt::format("the odometry slips: true turns are {:+.1f} +- {:.1f} % of what it reports", 100 * cause.found,
                         100 * cause.sigma);
    case CauseKind::kCurve:
      return fmt::format("each metre turns the robot by {:+.1f} +- {:.1f} deg that odometry does not report",
                         kInDegrees * cause.found, kInDegrees * cause.sigma);
    case CauseKind::kPad:
      return fmt::format("boxes of {} are {:.1f} +- {:.1f} px too {} on each side", name, std::abs(cause.found),
                         cause.sigma, cause.found > 0 ? "wide" : "narrow");
  }
  return "";
}

std::string what_to_do(const Cause& cause, const record::Signature* signature, const std::string& log) {
  switch (cause.kind) {
    case CauseKind::kPad:
      return fmt::format("{} {:.0f} px {} each edge where the boxes are made, or train the colour again",
                         cause.found > 0 ? "take" : "add", std::max(1.0, std::round(std::abs(cause.found))),
                         cause.found > 0 ? "off" : "to");
    case CauseKind::kWidth:
      if (signature == nullptr) return "";
      return fmt::format("measure it; by this log: $FPSIG,{},{:02x}{:02x}{:02x},{},{:.3f}", signature->signature,
                         signature->rgb.red, signature->rgb.green, signature->rgb.blue,
                         printable(signature->name.view()), cause.found);
    case CauseKind::kStep:
    case CauseKind::kTurn:
    case CauseKind::kCurve:
      return fmt::format(
          "'fencepost calibrate {} --robot robot.json --write-robot calibrated.json' corrects the wheels",
          printable(log));
    default: return fmt::format("'fencepost calibrate {} --write-camera camera.txt' corrects it", printable(log));
  }
}

Code code_of(CauseKind kind) {
  switch (kind) {
    case CauseKind::kFocal: return "distance_focal_length";
    case CauseKind::kYaw: return "distance_yaw";
    case CauseKind::kPitch: return "distance_pitch";
    case CauseKind::kLatency: return "distance_latency";
    case CauseKind::kHeight: return "distance_height";
    case CauseKind::kStep: return "distance_ways";
    case CauseKind::kTurn: return "distance_turns";
    case CauseKind::kCurve: return "distance_curve";
    case CauseKind::kPad: return "distance_pad";
    case CauseKind::kWidth: return "distance_width";
  }
  return {};
}

}  // namespace

doctor::Findings findings_of_causes(const std::vector<Cause>& causes, const std::vector<record::Signature>& signatures,
                                    const std::string& log) {
  doctor::Findings findings;
  for (const Cause& cause : causes) {
    const auto known = cause.signature ? std::ranges::find(signatures, *cause.signature, &record::Signature::signature)
                                       : signatures.end();
    const std::string name = cause.signature ? signature_name(signatures, *cause.signature) : "all colours";
    std::string what = what_it_is(cause, printable(name)) + fmt::format(" (by {} object{} in {} boxes)", cause.objects,
                                                                        cause.objects == 1 ? "" : "s", cause.sightings);
    for (std::size_t i = 0; i < cause.or_else.size(); ++i) {
      what += fmt::format("{} {}", i == 0 ? "; this log does not exclude" : " or", words(cause.or_else[i]));
    }
    if (!cause.or_else.empty()) what += " instead";
    findings.push_back({doctor::Severity::kWarning, code_of(cause.kind), std::move(what),
                        what_to_do(cause, known == signatures.end() ? nullptr : &*known, log)});
  }
  return findings;
}

}  // namespace fencepost::host
