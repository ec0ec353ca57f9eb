#include "host/export/nav2_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "host/export/robot_body.hpp"
#include "host/geometry/rings.hpp"

namespace fencepost::host::exports {
namespace {

/// Greys of map_server's own saver; with our free_thresh the unknown stays unknown when it is loaded again.
enum Grey : unsigned char { kOccupied = 0, kFree = 254, kUnknown = 205 };
constexpr double kAir = 0.5;  ///< m around everything

class Grid {
 public:
  Grid(Point low, Point high, double resolution)
      : low_(low),
        resolution_(resolution),
        columns_(static_cast<std::size_t>(std::ceil((high.x - low.x) / resolution))),
        rows_(static_cast<std::size_t>(std::ceil((high.y - low.y) / resolution))),
        cells_(columns_ * rows_, kUnknown) {}

  /// Sets each cell with its centre within `reach` of `about` for which `holds(centre)`.
  template <class Holds>
  void set_near(Point about, double reach, Grey grey, Holds holds) {
    const auto index = [this](double metres, std::size_t most) {
      return static_cast<std::size_t>(std::clamp(std::floor(metres / resolution_), 0.0, static_cast<double>(most)));
    };
    const std::size_t right = index(about.x + reach - low_.x + resolution_, columns_);
    const std::size_t top = index(about.y + reach - low_.y + resolution_, rows_);
    for (std::size_t row = index(about.y - reach - low_.y, rows_); row < top; ++row) {
      for (std::size_t column = index(about.x - reach - low_.x, columns_); column < right; ++column) {
        const Point centre{low_.x + (static_cast<double>(column) + 0.5) * resolution_,
                           low_.y + (static_cast<double>(row) + 0.5) * resolution_};
        if (holds(centre)) cells_[row * columns_ + column] = grey;
      }
    }
  }

  [[nodiscard]] std::size_t count(Grey grey) const {
    return static_cast<std::size_t>(std::ranges::count(cells_, static_cast<unsigned char>(grey)));
  }
  /// The first row of the image is the top one, of the largest y.
  [[nodiscard]] std::string pgm() const {
    std::string bytes = fmt::format("P5\n{} {}\n255\n", columns_, rows_);
    for (std::size_t row = rows_; row-- > 0;) {
      bytes.append(reinterpret_cast<const char*>(&cells_[row * columns_]), columns_);
    }
    return bytes;
  }

 private:
  Point low_;
  double resolution_;
  std::size_t columns_;
  std::size_t rows_;
  std::vector<unsigned char> cells_;  ///< from the bottom row on
};

struct Bounds {
  Point low{HUGE_VAL, HUGE_VAL};
  Point high{-HUGE_VAL, -HUGE_VAL};
  void add(Point p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  [[nodiscard]] double half() const { return std::hypot(high.x - low.x, high.y - low.y) / 2; }
  [[nodiscard]] Point middle() const { return {(low.x + high.x) / 2, (low.y + high.y) / 2}; }
};

std::vector<Polygon> solid_outlines(const Run& run, const std::string& model) {
  std::vector<Polygon> outlines;
  for (const ObjectResult& object : run.document.objects) {
    if (!is_solid(object)) continue;
    const ModelResult* outline = outline_of(object, model);
    if (outline == nullptr) outline = outline_of(object, "");  // without that model it is there all the same
    if (outline != nullptr) outlines.insert(outlines.end(), outline->geometry.begin(), outline->geometry.end());
  }
  return outlines;
}

void drive(Grid& grid, const Run& run, double resolution) {
  const RobotBody body = body_of(run.settings);
  const double reach = body.reach();
  const PoseResult* last = nullptr;
  for (const PoseResult& pose : run.document.path) {
    constexpr double kTurned = 0.05;  // rad
    const bool moved = last == nullptr || std::hypot(pose.x - last->x, pose.y - last->y) > resolution / 2 ||
                       std::abs(pose.heading - last->heading) > kTurned;
    if (!moved) continue;
    last = &pose;
    const double c = std::cos(pose.heading);
    const double s = std::sin(pose.heading);
    grid.set_near({pose.x, pose.y}, reach, kFree, [&](Point p) {
      const double dx = p.x - pose.x;
      const double dy = p.y - pose.y;
      return body.covers({c * dx + s * dy, c * dy - s * dx});
    });
  }
}

void occupy(Grid& grid, const Polygon& outline, double resolution) {
  Bounds bounds;
  for (const Point& p : outline.outer) bounds.add(p);
  const double half_diagonal = resolution * std::sqrt(0.5);
  grid.set_near(bounds.middle(), bounds.half() + resolution, kOccupied, [&](Point p) {
    return contains(outline, p) || distance_to_outline(p, outline.outer) <= half_diagonal;
  });
}

std::string map_yaml(const std::string& image, double resolution, Point low) {
  return fmt::format(
      "image: {}\nmode: trinary\nresolution: {:.6g}\norigin: [{:.6f}, {:.6f}, 0.0]\nnegate: 0\n"
      "occupied_thresh: 0.65\nfree_thresh: 0.196\n",
      nlohmann::json(image).dump(), resolution, low.x, low.y);  // JSON's strings are YAML's too
}

}  // namespace

std::optional<Nav2Map> nav2_map(const Run& run, const std::string& model, double resolution, const std::string& image) {
  const std::vector<Polygon> outlines = solid_outlines(run, model);
  Bounds bounds;
  bounds.add({0, 0});
  for (const PoseResult& pose : run.document.path) bounds.add({pose.x, pose.y});
  for (const Polygon& outline : outlines) {
    for (const Point& p : outline.outer) bounds.add(p);
  }
  for (const GuardPoint& point : run.document.guard) bounds.add({point.x, point.y});
  const double air = kAir + body_of(run.settings).reach();
  // Whole cells from the map's origin on: maps of two runs fit each other.
  const auto floored = [resolution](double metres) { return std::floor(metres / resolution) * resolution; };
  const Point low{floored(bounds.low.x - air), floored(bounds.low.y - air)};
  const Point high{bounds.high.x + air, bounds.high.y + air};
  if ((high.x - low.x) / resolution * ((high.y - low.y) / resolution) > kMaxCells) return std::nullopt;

  Grid grid(low, high, resolution);
  drive(grid, run, resolution);
  for (const Polygon& outline : outlines) occupy(grid, outline, resolution);
  for (const GuardPoint& point : run.document.guard) {
    const Point at{point.x, point.y};
    grid.set_near(at, resolution, kOccupied,
                  [&](Point p) { return std::hypot(p.x - at.x, p.y - at.y) <= resolution * std::sqrt(0.5); });
  }
  return Nav2Map{map_yaml(image, resolution, low), grid.pgm(), grid.count(kOccupied), grid.count(kFree)};
}

std::string collision_monitor(const Run& run) {
  const RobotBody body = body_of(run.settings);
  const double side = body.half_width + static_cast<double>(run.settings.number(config::Key::kRobotMargin));
  const auto zone = [&](const char* name, const char* action, config::Key key, const char* more) {
    // Alerts count from the robot's origin; a body that reaches farther than half its width moves them on.
    const double ahead = static_cast<double>(run.settings.number(key)) + std::max(0.0, body.front - body.half_width);
    return fmt::format(
        "    {0}:\n      type: \"polygon\"\n"
        "      points: \"[[{1:.3f}, {2:.3f}], [{1:.3f}, -{2:.3f}], [-{3:.3f}, -{2:.3f}], [-{3:.3f}, {2:.3f}]]\"\n"
        "      action_type: \"{4}\"\n      min_points: 1\n{5}      visualize: true\n"
        "      polygon_pub_topic: \"{0}\"\n      enabled: true\n",
        name, ahead, side, body.rear, action, more);
  };
  return "# The robot's own alert zones (alert.stop, alert.warn, robot.*), in its frame, m: merge this into the\n"
         "# parameters of nav2_collision_monitor, which needs observation_sources and topics of your robot beside it.\n"
         "collision_monitor:\n  ros__parameters:\n    base_frame_id: \"base_link\"\n"
         "    polygons: [\"fencepost_stop\", \"fencepost_warn\"]\n" +
         zone("fencepost_stop", "stop", config::Key::kAlertStop, "") +
         zone("fencepost_warn", "slowdown", config::Key::kAlertWarn, "      slowdown_ratio: 0.5\n");
}

}  // namespace fencepost::host::exports
