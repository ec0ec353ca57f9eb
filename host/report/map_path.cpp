#include "host/report/map_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/report/markup.hpp"
#include "host/report/ticks.hpp"
#include "host/result/thinned.hpp"

namespace fencepost::host {
namespace {

using markup::figure;
using markup::px;

constexpr double kFinest = 0.7;  ///< px; shorter pieces of the line cannot be seen
constexpr std::size_t kMaxPoints = 20'000;
constexpr double kTickSpacing = 34;  ///< px along the path
constexpr double kMaxTicks = 1'000;
constexpr double kDegreesPerRadian = 180 / std::numbers::pi;
constexpr double kTimeMarks = 8;       ///< maximum number of them, roughly
constexpr double kLabelSpacing = 40;   ///< px between time labels
constexpr double kEndSpacing = 110;    ///< px kept free for the label of the end
constexpr double kLabelDistance = 15;  ///< px beside the path

double pixel_distance(const MapFrame& f, const PoseResult& a, const PoseResult& b) {
  return std::hypot(a.x - b.x, a.y - b.y) * f.scale;
}

std::string draw_line(const MapFrame& f, const std::vector<PoseResult>& whole) {
  const std::vector<PoseResult> path = whole.size() > kMaxPoints ? thin_path_to(whole, kMaxPoints) : whole;
  std::string points = fmt::format("{},{}", px(f.x(path.front().x)), px(f.y(path.front().y)));
  const PoseResult* last = &path.front();
  for (const PoseResult& pose : path) {
    if (pixel_distance(f, *last, pose) < kFinest && &pose != &path.back()) continue;
    points += fmt::format(" {},{}", px(f.x(pose.x)), px(f.y(pose.y)));
    last = &pose;
  }
  return fmt::format(R"(<polyline class="track" points="{}"/>)", points);
}

/// An arrow head every kTickSpacing, of a long path less often. It shows the robot's heading, also where it turned on
/// the spot or drove back.
std::string draw_heading_ticks(const MapFrame& f, const std::vector<PoseResult>& path) {
  std::string svg;
  const double spacing = std::max(kTickSpacing, path_length(path) * f.scale / kMaxTicks);
  double since = spacing / 2;
  const PoseResult* last = &path.front();
  for (const PoseResult& pose : path) {
    since += pixel_distance(f, *last, pose);
    last = &pose;
    if (since < spacing) continue;
    since = 0;
    svg += fmt::format(R"svg(<path class="tick" transform="translate({} {}) rotate({})" d="M-4 -4.5L3 0L-4 4.5"/>)svg",
                       px(f.x(pose.x)), px(f.y(pose.y)), px(-pose.heading * kDegreesPerRadian));
  }
  return svg;
}

/// Which way the path runs there (rad); the heading where the robot stood still. They differ for a robot that drives
/// sideways, as some do.
double direction_of_travel(const MapFrame& f, const std::vector<PoseResult>& path, std::size_t at) {
  constexpr double kBaseline = 8;  // px: smooths odometry jitter
  std::size_t before = at;
  std::size_t after = at;
  while (before > 0 && pixel_distance(f, path[before], path[at]) < kBaseline) --before;
  while (after + 1 < path.size() && pixel_distance(f, path[after], path[at]) < kBaseline) ++after;
  if (pixel_distance(f, path[before], path[after]) < kFinest) return path[at].heading;
  return std::atan2(path[after].y - path[before].y, path[after].x - path[before].x);
}

constexpr double kTextReach = 40;  ///< px: a time further from its place says nothing

enum class Reach { kOutwards, kBackwards };

/// A text on the right of the path. At the ends it reaches backwards: ahead of the robot are the obstacles.
std::string beside(const MapFrame& f, LabelSpace& space, const std::vector<PoseResult>& path, std::size_t at,
                   double distance, Reach reach, const std::string& text) {
  const double travel = direction_of_travel(f, path, at);
  const double across = travel - std::numbers::pi / 2;
  const double x = f.x(path[at].x) + std::cos(across) * distance;
  const double y = f.y(path[at].y) - std::sin(across) * distance;
  const double away = std::cos(across);
  double side = away > 0.4 ? 1 : away < -0.4 ? -1 : 0;
  if (reach == Reach::kBackwards && std::abs(std::cos(travel)) > 0.4) side = std::cos(travel) > 0 ? -1 : 1;
  const Point best{x + side * text_width(text) / 2, y + 4.5};
  const auto placed = space.place(best, {f.x(path[at].x), f.y(path[at].y)}, text, 1, kTextReach);
  if (!placed) return {};
  return fmt::format(R"(<text x="{}" y="{}" text-anchor="middle">{}</text>)", px(placed->at.x), px(placed->at.y), text);
}

std::string draw_times(const MapFrame& f, LabelSpace& space, const std::vector<PoseResult>& path) {
  const double duration = path.back().t - path.front().t;
  if (duration <= 0) return {};
  const double step = nice_step(duration / kTimeMarks);
  std::string svg;
  double next = std::floor(path.front().t / step) * step + step;
  std::size_t labelled = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (path[i].t < next) continue;
    next = std::floor(path[i].t / step) * step + step;
    svg += fmt::format(R"(<circle class="mark" cx="{}" cy="{}" r="3"/>)", px(f.x(path[i].x)), px(f.y(path[i].y)));
    const bool room = pixel_distance(f, path[labelled], path[i]) > kLabelSpacing &&
                      pixel_distance(f, path.back(), path[i]) > kEndSpacing;
    if (!room) continue;
    svg += beside(f, space, path, i, kLabelDistance, Reach::kOutwards, figure(path[i].t, step_decimals(step)) + " s");
    labelled = i;
  }
  return svg;
}

}  // namespace

std::string draw_path(const MapFrame& f, const std::vector<PoseResult>& path, LabelSpace& space) {
  if (path.empty()) return {};
  const PoseResult& start = path.front();
  const PoseResult& end = path.back();
  std::string ends =
      fmt::format(R"(<circle class="start" cx="{}" cy="{}" r="5.5"/>)", px(f.x(start.x)), px(f.y(start.y)));
  ends += beside(f, space, path, 0, 20, Reach::kBackwards, "start");
  const double degrees = -end.heading * kDegreesPerRadian;
  ends +=
      fmt::format(R"svg(<path class="robot" transform="translate({} {}) rotate({})" d="M13 0L-8 -8L-4 0L-8 8z"/>)svg",
                  px(f.x(end.x)), px(f.y(end.y)), px(degrees));
  ends += beside(f, space, path, path.size() - 1, 22, Reach::kBackwards, fmt::format("end, {} s", figure(end.t, 1)));
  return R"(<g class="layer-path">)" + draw_line(f, path) + draw_heading_ticks(f, path) + draw_times(f, space, path) +
         ends + "</g>\n";
}

double path_length(const std::vector<PoseResult>& path) {
  double length = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    length += std::hypot(path[i].x - path[i - 1].x, path[i].y - path[i - 1].y);
  }
  return length;
}

}  // namespace fencepost::host
