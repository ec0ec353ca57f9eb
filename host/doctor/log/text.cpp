#include "host/doctor/log/text.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "host/text/plural.hpp"
#include "host/text/printable.hpp"

namespace fencepost::host::doctor {
namespace {

using Json = nlohmann::ordered_json;

std::string stream_line(const char* name, const Spacing& spacing) {
  std::string text = fmt::format("  {:<9} {:>7} records", name, spacing.count);
  if (spacing.count < 2) return text + "\n";
  text += fmt::format(", {:.1f} a second, longest gap {:.2f} s", spacing.rate, spacing.longest);
  return text + (spacing.gaps > 0 ? ", " + plural(spacing.gaps, "gap") + "\n" : "\n");
}

std::string camera_line(const LogSurvey& survey) {
  if (survey.calibrations.empty()) return {};
  const sensor::CameraIntrinsics& camera = survey.calibrations.back();
  const std::string pitch = camera.mount.pitch ? fmt::format("{:.4f} rad", camera.mount.pitch->to_double()) : "unknown";
  return fmt::format("  {:<9} {}, {} x {} px, fx {:.1f}, {:.3f} m high, pitch {}, latency {:.3f} s\n", "FPCAM",
                     printable(camera.model.view()), camera.width, camera.height, camera.fx.to_double(),
                     camera.mount.z.to_double(), pitch, camera.latency.to_double());
}

std::string colour_table(const LogSurvey& survey) {
  if (survey.colours.empty()) return {};
  std::string text =
      "\n  colour        frames   seen  blobs  flicker   jitter\n"
      "                          %   /frame     /100     px\n";
  for (const ColourQuality& colour : survey.colours) {
    const std::string jitter = colour.jitter_px > 0 ? fmt::format("{:.1f}", colour.jitter_px) : "-";
    text += fmt::format("  {:<12} {:>7} {:>6.1f} {:>6.2f} {:>8.1f} {:>8}\n",
                        printable(colour_name(survey, colour.signature)), colour.frames, 100 * colour.seen,
                        colour.blobs, colour.flicker, jitter);
  }
  return text;
}

Json spacing_json(const Spacing& spacing) {
  return {{"records", spacing.count},
          {"rate", spacing.rate},
          {"gaps", spacing.gaps},
          {"longest_gap", spacing.longest},
          {"longest_gap_at", spacing.longest_at}};
}

}  // namespace

std::string colour_name(const LogSurvey& survey, std::uint8_t signature) {
  const auto found = survey.colour_names.find(signature);
  return found == survey.colour_names.end() || found->second.empty() ? fmt::format("signature {}", signature)
                                                                     : found->second;
}

std::string survey_text(const LogSurvey& survey) {
  return fmt::format("{}: {:.1f} s, {}, {:.2f} m driven\n", printable(survey.name), survey.seconds,
                     plural(survey.runs, "run"), survey.path) +
         stream_line("camera", survey.camera) + stream_line("odometry", survey.odometry) +
         fmt::format("  {:<9} {:>7} records, {} foreign, {} rejected\n", "lines", survey.counts.records,
                     survey.counts.foreign, survey.counts.rejected()) +
         camera_line(survey) + colour_table(survey);
}

Json survey_json(const LogSurvey& survey) {
  Json colours = Json::array();
  for (const ColourQuality& colour : survey.colours) {
    colours.push_back({{"signature", colour.signature},
                       {"name", printable(colour_name(survey, colour.signature))},
                       {"frames", colour.frames},
                       {"seen", colour.seen},
                       {"blobs_per_frame", colour.blobs},
                       {"flicker", colour.flicker},
                       {"jitter_px", colour.jitter_px},
                       {"jitter", colour.jitter}});
  }
  Json rejected = Json::object();
  for (std::size_t i = 0; i < record::kRejectReasons; ++i) {
    const auto reason = static_cast<record::Reject>(i);
    if (survey.counts.rejected(reason).lines > 0) {
      rejected[std::string(record::name(reason))] = survey.counts.rejected(reason).lines;
    }
  }
  return {{"log", printable(survey.name)},
          {"seconds", survey.seconds},
          {"runs", survey.runs},
          {"path", survey.path},
          {"camera", spacing_json(survey.camera)},
          {"odometry", spacing_json(survey.odometry)},
          {"lines",
           {{"records", survey.counts.records}, {"foreign", survey.counts.foreign}, {"rejected", std::move(rejected)}}},
          {"frames_missing", survey.frames_missing},
          {"clock_offset", survey.clock_offset},
          {"blind", survey.blind_seconds},
          {"colours", std::move(colours)}};
}

}  // namespace fencepost::host::doctor
