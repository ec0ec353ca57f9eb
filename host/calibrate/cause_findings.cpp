#include "host/calibrate/cause_findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "host/calibrate/known.hpp"
#include "host/calibrate/pads.hpp"
#include "host/live/record_line.hpp"
#include "host/text/plural.hpp"
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

/// Without its checksum, as it is typed.
std::string typed(const record::Signature& signature) {
  const std::string line = record_line(signature);
  return line.substr(0, line.find('*'));
}

/// The records of these colours without the pad that was found beside what is configured.
std::string unpad(const Cause& cause, std::vector<record::Signature> signatures) {
  std::string lines;
  for (record::Signature& signature : signatures) {
    signature.pad = whole_pad(signature.pad + cause.found);
    lines += (lines.empty() ? "" : " ") + typed(signature);
  }
  if (lines.empty()) return "name the colour by $FPSIG and give its pad there";
  return "configure it as the pad of the colour; by this log: " + lines;
}

/// `signatures`: that it is about.
std::string what_to_do(const Cause& cause, const std::vector<record::Signature>& signatures, const std::string& log) {
  switch (cause.kind) {
    case CauseKind::kPad: return unpad(cause, signatures);
    case CauseKind::kWidth: {
      if (signatures.empty()) return "";
      record::Signature signature = signatures.front();
      signature.width = static_cast<std::uint16_t>(std::lround(1e3 * cause.found));
      return "measure it; by this log: " + typed(signature);
    }
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
    std::vector<record::Signature> about;
    std::ranges::copy_if(signatures, std::back_inserter(about), [&](const record::Signature& signature) {
      return !cause.signature || signature.signature == *cause.signature;
    });
    const std::string name = cause.signature ? signature_name(signatures, *cause.signature) : "all colours";
    std::string what =
        what_it_is(cause, printable(name)) +
        fmt::format(" (by {} in {})", plural(cause.objects, "object"), plural(cause.sightings, "box", "boxes"));
    for (std::size_t i = 0; i < cause.or_else.size(); ++i) {
      what += fmt::format("{} {}", i == 0 ? "; this log does not exclude" : " or", words(cause.or_else[i]));
    }
    if (!cause.or_else.empty()) what += " instead";
    findings.push_back(
        {doctor::Severity::kWarning, code_of(cause.kind), std::move(what), what_to_do(cause, about, log)});
  }
  return findings;
}

}  // namespace fencepost::host
