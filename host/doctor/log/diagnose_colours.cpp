#include <fmt/format.h>

#include "host/doctor/log/diagnose.hpp"
#include "host/doctor/log/text.hpp"

namespace fencepost::host::doctor {
namespace {

using enum Severity;

// On the bundled recordings and simulated scenes of one pixel's noise flicker is 4.2 at most and jitter 3.5 px or less
// than 0.1.
constexpr double kMuchFlicker = 10;   // of 100 frames with it
constexpr double kMuchJitter = 0.15;  // of the width
constexpr double kMuchJitterPx = 3;
constexpr std::uint64_t kEnough = 30;  // frames
constexpr double kManyPieces = 3;

}  // namespace

void diagnose_colours(const LogSurvey& survey, Findings& findings) {
  if (survey.camera.count > 0 && survey.colours.empty()) {
    findings.push_back({kWarning, "nothing_seen", "the camera never saw a blob",
                        "train a colour in this light, and look whether the lens cap is off"});
  }
  for (const ColourQuality& colour : survey.colours) {
    const std::string name = colour_name(survey, colour.signature);
    if (!survey.colour_names.empty() && !survey.colour_names.contains(colour.signature)) {
      findings.push_back({kNote, "colour_unnamed", fmt::format("signature {} has no name", colour.signature),
                          "add it to the robot's signatures, or the camera was trained for more than was meant"});
    }
    if (colour.frames < kEnough) continue;
    if (colour.flicker > kMuchFlicker) {
      findings.push_back({kWarning, "colour_flicker",
                          fmt::format("{} flickers: gone and back {:.0f} times in 100 frames", name, colour.flicker),
                          "train it again in this light, and widen its range"});
    }
    if (colour.jitter > kMuchJitter && colour.jitter_px > kMuchJitterPx) {
      findings.push_back({kWarning, "colour_jitter",
                          fmt::format("the size of {} jumps by {:.1f} px from frame to frame, {:.0f} % of its width",
                                      name, colour.jitter_px, 100 * colour.jitter),
                          "light from one side, a glossy surface, or a range too narrow: train it again"});
    }
    if (colour.blobs > kManyPieces) {
      findings.push_back({kNote, "colour_pieces", fmt::format("{:.1f} blobs of {} in a frame", colour.blobs, name),
                          "if there are fewer things of it: it falls to pieces, or the background has its colour"});
    }
  }
}

}  // namespace fencepost::host::doctor
