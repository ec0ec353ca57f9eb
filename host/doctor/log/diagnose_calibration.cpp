#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/doctor/log/diagnose.hpp"
#include "host/text/plural.hpp"

namespace fencepost::host::doctor {
namespace {

using enum Severity;

constexpr double kNarrowest = 15;      // deg across, of lenses that robots have
constexpr double kWidest = 150;        // deg, of a pinhole; of a fisheye the stream's own limit is 150
constexpr double kOffCentre = 0.15;    // of the image's width or height
constexpr double kOblong = 0.2;        // fx against fy
constexpr double kLowest = 0.01;       // m above the floor
constexpr double kHighest = 1.5;       // m
constexpr double kSteepest = 45;       // deg
constexpr double kSlowest = 0.5;       // s
constexpr double kLensDiffers = 0.25;  // of the maker's focal length: no calibration of one lens moves so far

/// Across the image, deg; without distortion.
double field_of_view(const sensor::CameraIntrinsics& camera) {
  const double edge = camera.width / 2.0 / camera.fx.to_double();
  return degrees(2 * (camera.lens == sensor::Lens::kEquidistant ? edge : std::atan(edge)));
}

void check_lens(const sensor::CameraIntrinsics& camera, Findings& findings) {
  const double view = field_of_view(camera);
  if (view < kNarrowest || view > kWidest) {
    findings.push_back({kFault, "calibration_field_of_view",
                        fmt::format("FPCAM says that the camera sees {:.0f} deg across (fx {:.1f} of {} px)", view,
                                    camera.fx.to_double(), camera.width),
                        "fx is in pixels of the blobs' own image, not of the sensor: 'fencepost calibrate' finds it"});
  }
  const double off_x = std::abs(camera.cx.to_double() - (camera.width - 1) / 2.0) / camera.width;
  const double off_y = std::abs(camera.cy.to_double() - (camera.height - 1) / 2.0) / camera.height;
  if (std::max(off_x, off_y) > kOffCentre) {
    findings.push_back({kWarning, "calibration_centre",
                        fmt::format("the optical axis is at {:.1f}, {:.1f} of {} x {} px", camera.cx.to_double(),
                                    camera.cy.to_double(), camera.width, camera.height),
                        "it lies near the middle: was it calibrated at another image size?"});
  }
}

void check_mount(const sensor::CameraIntrinsics& camera, Findings& findings) {
  const double height = camera.mount.z.to_double();
  if (height < kLowest || height > kHighest) {
    findings.push_back({kFault, "calibration_height",
                        fmt::format("FPCAM has the camera {:.3f} m above the floor", height),
                        "measure from the floor to the lens and give it in metres: mount z"});
  }
  if (!camera.mount.pitch) {
    findings.push_back({kNote, "calibration_pitch_unknown", "the camera's pitch is not known: ground rows are not used",
                        "'fencepost calibrate' finds it; 0 only where it was levelled"});
  } else if (std::abs(degrees(camera.mount.pitch->to_double())) > kSteepest) {
    findings.push_back(
        {kFault, "calibration_pitch",
         fmt::format("FPCAM has the camera tilted by {:.0f} deg", degrees(camera.mount.pitch->to_double())),
         "it is in rad and positive downwards"});
  }
  if (camera.latency.to_double() > kSlowest) {
    findings.push_back({kFault, "calibration_latency",
                        fmt::format("FPCAM has frames {:.2f} s late", camera.latency.to_double()), "it is in seconds"});
  }
}

/// Checks a camera whose maker does not say otherwise for oblong pixels.
void check_oblong(const sensor::CameraIntrinsics& camera, Findings& findings) {
  const double fx = camera.fx.to_double();
  const double fy = camera.fy.to_double();
  if (std::abs(fx - fy) > kOblong * fx) {
    findings.push_back({kWarning, "calibration_oblong", fmt::format("fx {:.1f} and fy {:.1f} differ", fx, fy),
                        "pixels are square on most cameras"});
  }
}

void check_maker(const sensor::CameraIntrinsics& camera, const std::vector<sensor::CameraIntrinsics>& makers,
                 Findings& findings) {
  const auto maker = std::ranges::find_if(makers, [&](const auto& known) { return known.model == camera.model; });
  if (maker == makers.end() || maker->fx.raw == 0) return check_oblong(camera, findings);
  const bool size = maker->width != camera.width || maker->height != camera.height;
  const double scale = static_cast<double>(camera.width) / maker->width;
  const double share = camera.fx.to_double() / (scale * maker->fx.to_double()) - 1;
  if (size) {
    findings.push_back({kWarning, "calibration_size",
                        fmt::format("FPCAM has {} with {} x {} px; it tells blobs of {} x {}", camera.model.view(),
                                    camera.width, camera.height, maker->width, maker->height),
                        "calibrate in the units in which the camera tells its blobs"});
  }
  if (std::abs(share) > kLensDiffers) {
    findings.push_back(
        {kWarning, "calibration_lens",
         fmt::format("the focal length is {:+.0f} % of what the maker of {} says", 100 * share, camera.model.view()),
         "is it another model or lens? 'fencepost calibrate' measures it"});
  }
}

}  // namespace

void diagnose_calibration(const LogSurvey& survey, const std::vector<sensor::CameraIntrinsics>& makers,
                          Findings& findings) {
  if (survey.calibrations.empty()) {
    if (survey.camera.count == 0) return;
    findings.push_back({kFault, "no_calibration", "no FPCAM: nothing says how the camera sees",
                        "replay takes one with --camera; on the robot, 'set camera' or --robot gives it"});
    return;
  }
  if (survey.calibrations.size() > survey.runs) {
    findings.push_back(
        {kWarning, "calibration_changed",
         fmt::format("the calibration changed: {} in {}", survey.calibrations.size(), plural(survey.runs, "run")),
         "'replay --diff' shows two logs' numbers beside each other"});
  }
  const sensor::CameraIntrinsics& camera = survey.calibrations.back();
  check_lens(camera, findings);
  check_mount(camera, findings);
  check_maker(camera, makers, findings);
}

void diagnose_doubts(const LogSurvey& survey, Findings& findings) {
  const auto& doubts = survey.replayed.result.calibration;
  if (doubts.empty() || doubts.back().doubt == record::Doubt::kNone) return;
  const bool rows = doubts.back().doubt == record::Doubt::kRows;
  findings.push_back({kFault, rows ? Code("calibration_rows") : Code("calibration_focal_length"),
                      fmt::format("what the camera sees contradicts {}: a factor of {:.2f}, since {:.1f} s",
                                  rows ? "its pitch or height" : "its focal length, or the track of the wheels",
                                  doubts.back().factor.to_double(), doubts.back().t.to_double()),
                      "'fencepost calibrate' on a short drive among blocks finds the right numbers"});
}

}  // namespace fencepost::host::doctor
