#include "host/smooth/smooth_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "host/result/geojson.hpp"
#include "host/result/lookup.hpp"
#include "host/result/to_json.hpp"
#include "host/text/plural.hpp"
#include "host/text/printable.hpp"

namespace fencepost::host {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr int kDecimals = 6;

std::string object_rows(const Smoothed& smoothed) {
  std::string text = fmt::format(
      "{:>4} {:<12} {:>9} {:>8} {:>8} {:>8} {:>8} {:>8}\n{:>4} {:<12} {:>9} {:>8} {:>8} {:>8} {:>8} {:>8}\n", "id",
      "name", "sightings", "x", "y", "+-", "radius", "top", "", "", "", "m", "m", "m", "m", "m");
  for (const SmoothedObject& object : smoothed.objects) {
    const std::string name = printable(signature_name(smoothed.online, object.signature)).substr(0, 12);
    const std::string sigma = object.sigma ? fmt::format("{:.3f}", *object.sigma) : "-";
    const std::string top = object.top > 0 ? fmt::format("{:.3f}", object.top) : "-";
    text += fmt::format("{:>4} {:<12} {:>9} {:>8.3f} {:>8.3f} {:>8} {:>8.3f} {:>8}\n", object.id, name,
                        object.sightings, object.centre.x, object.centre.y, sigma, object.radius, top);
  }
  return text;
}

std::string what_was_done(const Smoothed& smoothed) {
  std::string text = fmt::format("edges (68 %)      {:.2f} px by the online path, {:.2f} px now\n",
                                 smoothed.edges_before, smoothed.edges_after);
  text += fmt::format("odometry          turns stray {:.1f}, ways {:.1f} times as much as of good wheels\n",
                      smoothed.drift, smoothed.walk);
  text += fmt::format("boxes             {} used, {} of them new, {} taken back\n", smoothed.sightings, smoothed.added,
                      smoothed.taken_back);
  text += fmt::format("objects           {} joined with another, {} left out\n", smoothed.joined, smoothed.left_out);
  return text;
}

std::string calibration_rows(const Smoothed& smoothed) {
  if (smoothed.findings.empty()) return "";
  std::string text = fmt::format("\n{:<18}{:>10}{:>11}{:>10}\n", "", "configured", "found", "+-");
  for (const Finding& finding : smoothed.findings) {
    const auto number = [&](double value) { return fmt::format("{:.{}f}", value, finding.decimals); };
    text += fmt::format("{:<18}{:>10}{:>11}{:>10}  {}\n", finding.label, number(finding.configured),
                        finding.held ? "not found" : number(finding.found), finding.held ? "" : number(finding.sigma),
                        finding.unit);
  }
  return text;
}

std::string par_rows(const Par& par) {
  std::string text =
      fmt::format("\nonline against optimum\nobjects           {} confirmed online, {} here, {} in both\n",
                  par.objects_online, par.objects_optimum, par.pairs);
  text += fmt::format("map, aligned      {:.3f} m rms, {:.3f} m at worst (turned by {:.1f} degrees)\n", par.map_rms,
                      par.map_worst, par.motion.turn * kDegrees);
  text += fmt::format("path, aligned     {:.3f} m rms\n", par.path_rms);
  return text + fmt::format("as they stand     last pose {:.3f} m off, heading {:.1f} degrees in the mean\n",
                            par.end_off, par.heading_mean * kDegrees);
}

/// At most kMax points: more cannot be seen.
Json path_json(const std::vector<PoseResult>& path) {
  constexpr std::size_t kMax = 2000;
  Json points = Json::array();
  const std::size_t count = std::min(path.size(), kMax);
  for (std::size_t i = 0; i < count; ++i) {
    const PoseResult& pose = path[count < 2 ? i : i * (path.size() - 1) / (count - 1)];
    points.push_back(
        {rounded(pose.t, 4), rounded(pose.x, kDecimals), rounded(pose.y, kDecimals), rounded(pose.heading, kDecimals)});
  }
  return points;
}

Json findings_json(const Smoothed& smoothed) {
  Json parameters = Json::object();
  for (const Finding& finding : smoothed.findings) {
    parameters[std::string(finding.key)] = {
        {"unit", finding.unit},
        {"configured", rounded(finding.configured, kDecimals)},
        {"found", finding.held ? Json(nullptr) : rounded(finding.found, kDecimals)},
        {"sigma", finding.held ? Json(nullptr) : rounded(finding.sigma, kDecimals)}};
  }
  return parameters;
}

}  // namespace

std::string smooth_text(const Smoothed& smoothed, const std::string& log_name) {
  std::string text = fmt::format("{}: {}, {}, {}, {:.0f} s, {:.1f} m, {:.0f} degrees turned\n\n", printable(log_name),
                                 plural(smoothed.frames, "frame"), plural(smoothed.poses, "pose"),
                                 plural(smoothed.objects.size(), "object"), smoothed.seconds, smoothed.driven,
                                 smoothed.turned * kDegrees);
  text += object_rows(smoothed) + "\n" + what_was_done(smoothed) + calibration_rows(smoothed) + par_rows(smoothed.par);
  return text;
}

std::string smooth_json(const Smoothed& smoothed) {
  Json json = Json::parse(to_json(smoothed.optimum));
  Json sigmas = Json::object();
  for (const SmoothedObject& object : smoothed.objects) {
    sigmas[std::to_string(object.id)] = object.sigma ? rounded(*object.sigma, kDecimals) : Json(nullptr);
  }
  json["path"] = path_json(smoothed.optimum.path);
  json["smooth"] = {
      {"frames", smoothed.frames},
      {"poses", smoothed.poses},
      {"sightings", smoothed.sightings},
      {"added", smoothed.added},
      {"taken_back", smoothed.taken_back},
      {"joined", smoothed.joined},
      {"left_out", smoothed.left_out},
      {"drift", rounded(smoothed.drift, 4)},
      {"walk", rounded(smoothed.walk, 4)},
      {"edges_px", {{"before", rounded(smoothed.edges_before, 4)}, {"after", rounded(smoothed.edges_after, 4)}}},
      {"sigma", std::move(sigmas)},
      {"parameters", findings_json(smoothed)}};
  const Par& par = smoothed.par;
  json["par"] = {{"objects_online", par.objects_online},
                 {"objects_optimum", par.objects_optimum},
                 {"pairs", par.pairs},
                 {"turn", rounded(par.motion.turn, kDecimals)},
                 {"map_rms", rounded(par.map_rms, kDecimals)},
                 {"map_worst", rounded(par.map_worst, kDecimals)},
                 {"path_rms", rounded(par.path_rms, kDecimals)},
                 {"end_off", rounded(par.end_off, kDecimals)},
                 {"heading_mean", rounded(par.heading_mean, kDecimals)}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace fencepost::host
