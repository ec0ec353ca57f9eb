#include "host/report/map_path.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "host/report/markup.hpp"
#include "host/report/ticks.hpp"

namespace fencepost::host {
namespace {

using markup::figure;
using markup::px;

constexpr double kFinest = 0.7;        ///< px; shorter pieces of the line cannot be seen
constexpr double kTickSpacing = 34;    ///< px along the path
constexpr double kTickLength = 9;      ///< px
constexpr double kTimeMarks = 8;       ///< at most about so many
constexpr double kLabelSpacing = 26;   ///< px between time labels
constexpr double kLabelDistance = 15;  ///< px beside the path

double pixel_distance(const MapFrame& f, const PoseResult& a, const PoseResult& b) {
  return std::hypot(a.x - b.x, a.y - b.y) * f.scale;
}

std::string draw_line(const MapFrame& f, const std::vector<PoseResult>& path) {
  std::string points = fmt::format("{},{}", px(f.x(path.front().x)), px(f.y(path.front().y)));
  const PoseResult* last = &path.front();
  for (const PoseResult& pose : path) {
    if (pixel_distance(f, *last, pose) < kFinest && &pose != &path.back()) continue;
    points += fmt::format(" {},{}", px(f.x(pose.x)), px(f.y(pose.y)));
    last = &pose;
  }
  return fmt::format(R"(<polyline class="track" points="{}"/>)", points);
}

std::string draw_heading_ticks(const MapFrame& f, const std::vector<PoseResult>& path) {
  std::string d;
  double since = kTickSpacing / 2;
  const PoseResult* last = &path.front();
  for (const PoseResult& pose : path) {
    since += pixel_distance(f, *last, pose);
    last = &pose;
    if (since < kTickSpacing) continue;
    since = 0;
    d += fmt::format("M{} {}l{} {}", px(f.x(pose.x)), px(f.y(pose.y)), px(std::cos(pose.heading) * kTickLength),
                     px(-std::sin(pose.heading) * kTickLength));
  }
  return d.empty() ? d : fmt::format(R"(<path class="tick" d="{}"/>)", d);
}

/// A text beside the path, on the robot's right; away from where objects of interest usually are drawn.
std::string beside(const MapFrame& f, const PoseResult& pose, double distance, const std::string& text) {
  const double across = pose.heading - std::numbers::pi / 2;
  const double x = f.x(pose.x) + std::cos(across) * distance;
  const double y = f.y(pose.y) - std::sin(across) * distance;
  const double side = std::cos(across);
  const char* anchor = side > 0.4 ? "start" : side < -0.4 ? "end" : "middle";
  return fmt::format(R"(<text x="{}" y="{}" text-anchor="{}">{}</text>)", px(x), px(y + 4.5), anchor, text);
}

std::string draw_times(const MapFrame& f, const std::vector<PoseResult>& path) {
  const double duration = path.back().t - path.front().t;
  if (duration <= 0) return {};
  const double step = nice_step(duration / kTimeMarks);
  std::string svg;
  double next = std::floor(path.front().t / step) * step + step;
  const PoseResult* labelled = &path.front();
  for (const PoseResult& pose : path) {
    if (pose.t < next) continue;
    next = std::floor(pose.t / step) * step + step;
    svg += fmt::format(R"(<circle class="mark" cx="{}" cy="{}" r="3"/>)", px(f.x(pose.x)), px(f.y(pose.y)));
    const bool room =
        pixel_distance(f, *labelled, pose) > kLabelSpacing && pixel_distance(f, path.back(), pose) > kLabelSpacing;
    if (!room) continue;
    svg += beside(f, pose, kLabelDistance, figure(pose.t, step_decimals(step)) + " s");
    labelled = &pose;
  }
  return svg;
}

}  // namespace

std::string draw_path(const MapFrame& f, const std::vector<PoseResult>& path) {
  if (path.empty()) return {};
  const PoseResult& start = path.front();
  const PoseResult& end = path.back();
  std::string svg =
      R"(<g class="layer-path">)" + draw_line(f, path) + draw_heading_ticks(f, path) + draw_times(f, path);
  svg += fmt::format(R"(<circle class="start" cx="{}" cy="{}" r="5.5"/>)", px(f.x(start.x)), px(f.y(start.y)));
  svg += beside(f, start, 20, "start");
  const double degrees = -end.heading * 180 / std::numbers::pi;
  svg +=
      fmt::format(R"svg(<path class="robot" transform="translate({} {}) rotate({})" d="M13 0L-8 -8L-4 0L-8 8z"/>)svg",
                  px(f.x(end.x)), px(f.y(end.y)), px(degrees));
  svg += beside(f, end, 22, fmt::format("end, {} s", figure(end.t, 1)));
  return svg + "</g>\n";
}

double path_length(const std::vector<PoseResult>& path) {
  double length = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    length += std::hypot(path[i].x - path[i - 1].x, path[i].y - path[i - 1].y);
  }
  return length;
}

}  // namespace fencepost::host
