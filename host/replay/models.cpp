#include "host/replay/models.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>

namespace fencepost::host {
namespace {

constexpr int kCircleVertices = 64;

Point to_map(recon::MapPoint origin, double x, double y) {
  return {static_cast<double>(origin.x) / recon::kMapUnitsPerMetre + x,
          static_cast<double>(origin.y) / recon::kMapUnitsPerMetre + y};
}

Polygon map_polygon(recon::MapPoint origin, std::span<const recon::Vec2> vertices) {
  Polygon polygon;
  for (const recon::Vec2& v : vertices) {
    polygon.outer.push_back(to_map(origin, static_cast<double>(v.x()), static_cast<double>(v.y())));
  }
  return polygon;
}

void set_circle(ModelResult& model, Point center, double radius) {
  model.circle = Circle{center, radius};
  // The polygon's area is n/2 R^2 sin(2 pi / n); R makes it pi r^2.
  const double step = 2 * std::numbers::pi / kCircleVertices;
  const double outer = radius * std::sqrt(2 * std::numbers::pi / (kCircleVertices * std::sin(step)));
  Polygon polygon;
  for (int i = 0; i < kCircleVertices; ++i) {
    polygon.outer.push_back({center.x + outer * std::cos(i * step), center.y + outer * std::sin(i * step)});
  }
  model.geometry.push_back(std::move(polygon));
}

double signed_area(const LinearRing& ring) {
  double twice = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point& a = ring[i];
    const Point& b = ring[(i + 1) % ring.size()];
    twice += a.x * b.y - a.y * b.x;
  }
  return twice / 2;
}

// Traces the boundaries between solid and empty cells, solid on the left. Corners are (column, row) of the lattice.
class OutlineTracer {
 public:
  using Corner = std::pair<int, int>;

  OutlineTracer(std::size_t cells, std::span<const std::uint32_t> words)
      : cells_(static_cast<int>(cells)), words_(words) {
    for (int j = 0; j < cells_; ++j) {
      for (int i = 0; i < cells_; ++i) add_cell_edges(i, j);
    }
  }

  std::vector<std::vector<Corner>> loops() {
    while (!edges_.empty()) trace();
    return std::move(loops_);
  }

 private:
  [[nodiscard]] bool solid(int i, int j) const {
    if (i < 0 || j < 0 || i >= cells_ || j >= cells_) return false;
    const auto index = static_cast<std::size_t>(j * cells_ + i);
    return ((words_[index / 32] >> (index % 32)) & 1U) != 0;
  }
  void add_cell_edges(int i, int j) {
    if (!solid(i, j)) return;
    if (!solid(i, j - 1)) edges_.insert({{i, j}, {i + 1, j}});
    if (!solid(i + 1, j)) edges_.insert({{i + 1, j}, {i + 1, j + 1}});
    if (!solid(i, j + 1)) edges_.insert({{i + 1, j + 1}, {i, j + 1}});
    if (!solid(i - 1, j)) edges_.insert({{i, j + 1}, {i, j}});
  }
  // Where two solid cells meet at a corner only, turn left: the cells stay apart. A path that comes back to a corner (a
  // hole that touches itself or the outline) is cut there. So every loop is simple.
  void trace() {
    std::vector<Corner> path{edges_.begin()->first};
    Corner direction{0, 0};
    while (!path.empty()) {
      const Corner at = path.back();
      auto [first, last] = edges_.equal_range(at);
      if (first == last) return;
      auto chosen = first;
      for (auto edge = first; edge != last; ++edge) {
        const Corner next{edge->second.first - at.first, edge->second.second - at.second};
        if (direction.first * next.second - direction.second * next.first > 0) chosen = edge;
      }
      const Corner to = chosen->second;
      direction = {to.first - at.first, to.second - at.second};
      edges_.erase(chosen);
      const auto passed = std::find(path.begin(), path.end(), to);
      if (passed != path.end()) {
        loops_.push_back(corners_only({passed, path.end()}));
        path.erase(passed + 1, path.end());
      } else {
        path.push_back(to);
      }
    }
  }
  // Leaves out the corners of a loop where it goes straight on.
  static std::vector<Corner> corners_only(const std::vector<Corner>& loop) {
    std::vector<Corner> corners;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Corner& before = loop[(i + loop.size() - 1) % loop.size()];
      const Corner& after = loop[(i + 1) % loop.size()];
      const bool straight = before.first == after.first || before.second == after.second;
      if (!straight) corners.push_back(loop[i]);
    }
    return corners;
  }

  int cells_;
  std::span<const std::uint32_t> words_;
  std::multimap<Corner, Corner> edges_;
  std::vector<std::vector<Corner>> loops_;
};

// Does `outer` contain the lattice loop's first point, moved a little into the loop's inside?
bool contains(const LinearRing& ring, const Point& p) {
  bool inside = false;
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
    const bool crosses = (ring[i].y > p.y) != (ring[j].y > p.y);
    if (crosses && p.x < (ring[j].x - ring[i].x) * (p.y - ring[i].y) / (ring[j].y - ring[i].y) + ring[i].x) {
      inside = !inside;
    }
  }
  return inside;
}

}  // namespace

ModelResult cylinder_model(const recon::ObjectCore& object) {
  const recon::CylinderEstimate& estimate = object.cylinder.estimate();
  ModelResult model;
  model.name = "cylinder";
  model.reason = std::string(name(estimate.refusal));
  if (!estimate.ok()) return model;
  const auto x = static_cast<double>(estimate.center.x());
  const auto y = static_cast<double>(estimate.center.y());
  set_circle(model, to_map(object.origin, x, y), static_cast<double>(estimate.radius));
  return model;
}

ModelResult cylinder_paper_model(const recon::ObjectCore& object, const recon::CylinderPaper& paper) {
  const recon::PaperCylinder cylinder = paper.solve();
  ModelResult model;
  model.name = "cylinder_paper";
  if (!cylinder.ok) {
    model.reason = "fewer than two bearings that cross";
    return model;
  }
  const auto x = static_cast<double>(cylinder.center.x());
  const auto y = static_cast<double>(cylinder.center.y());
  set_circle(model, to_map(object.origin, x, y), static_cast<double>(cylinder.radius));
  return model;
}

ModelResult clip_model(const recon::ObjectCore& object, std::string name, std::span<const recon::Vec2> vertices) {
  ModelResult model;
  model.name = std::move(name);
  if (vertices.size() < 3) {
    model.reason = "contradictory wedges carved everything away";
    return model;
  }
  model.geometry.push_back(map_polygon(object.origin, vertices));
  return model;
}

namespace {

/// The runs of sides of which no edge was seen; `vertices` counter-clockwise.
std::vector<Polyline> open_sides(recon::MapPoint origin, std::span<const recon::Vec2> vertices,
                                 recon::ConstClusters clusters) {
  const std::size_t n = vertices.size();
  std::vector<bool> open;
  for (std::size_t i = 0; i < n; ++i) {
    const recon::Vec2 along = vertices[(i + 1) % n] - vertices[i];
    open.push_back(!recon::edge_seen(clusters, -recon::left_of(along)));
  }
  const auto closed = static_cast<std::size_t>(std::find(open.begin(), open.end(), false) - open.begin());
  std::vector<Polyline> runs;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t side = (closed + i) % n;
    if (!open[side]) continue;
    if (i == 0 || !open[(side + n - 1) % n]) runs.push_back(map_polygon(origin, vertices.subspan(side, 1)).outer);
    runs.back().push_back(map_polygon(origin, vertices.subspan((side + 1) % n, 1)).outer.front());
  }
  return runs;
}

// Where fits take turns: an outline that is not known well knows less than the cylinder once a whole view waits.
bool is_stale(const recon::HybridCore& hybrid) {
  if (hybrid.refusal != recon::HybridRefusal::kNone) return hybrid.fitting || hybrid.new_weight > 0;
  return !hybrid.known_well && (hybrid.fitting || hybrid.new_weight >= recon::kWholeView);
}

}  // namespace

ModelResult hybrid_model(const recon::ObjectCore& object, const recon::HybridCore& hybrid,
                         const recon::OutlineView& outline, recon::ConstClusters clusters) {
  ModelResult model;
  model.name = "hybrid";
  if (is_stale(hybrid) && object.cylinder.estimate().ok()) {
    model.geometry = cylinder_model(object).geometry;
    return model;
  }
  model.reason = std::string(name(hybrid.refusal));
  if (hybrid.refusal != recon::HybridRefusal::kNone) return model;
  std::array<recon::Vec2, recon::kOutlineVertices> vertices{};
  const std::size_t size = recon::outline_polygon(outline, 0, vertices);
  if (size == 0) {
    model.reason = std::string(name(recon::HybridRefusal::kEmpty));
    return model;
  }
  model.geometry.push_back(map_polygon(hybrid.origin, std::span(vertices).first(size)));
  model.open = open_sides(hybrid.origin, std::span(vertices).first(size), clusters);
  return model;
}

ModelResult sheaf_model(const recon::ObjectCore& object, std::string name, std::span<const recon::Vec2> hull,
                        recon::SheafRefusal refusal) {
  ModelResult model;
  model.name = std::move(name);
  model.reason = std::string(recon::name(refusal));
  if (refusal != recon::SheafRefusal::kNone) return model;
  model.geometry.push_back(map_polygon(object.origin, hull));
  return model;
}

ModelResult carve_model(const recon::ObjectCore& object, std::string name, const recon::GridPlacement& placement,
                        std::size_t cells, std::span<const std::uint32_t> words) {
  ModelResult model;
  model.name = std::move(name);
  if (!(placement.cell > 0)) {
    model.reason = "no place yet";
    return model;
  }
  std::vector<LinearRing> holes;
  for (const auto& loop : OutlineTracer(cells, words).loops()) {
    LinearRing ring;
    for (const auto& [column, row] : loop) {
      const auto cell = static_cast<double>(placement.cell);
      ring.push_back(to_map(object.origin, static_cast<double>(placement.low.x()) + column * cell,
                            static_cast<double>(placement.low.y()) + row * cell));
    }
    if (signed_area(ring) > 0) {
      model.geometry.push_back({std::move(ring), {}});
    } else {
      holes.push_back(std::move(ring));
    }
  }
  for (LinearRing& hole : holes) {
    // The middle of the hole's first side lies on the boundary of exactly one solid region: step into it.
    const Point a = hole[0];
    const Point b = hole[1];
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    const double step = 0.25 * static_cast<double>(placement.cell) / length;
    const Point inside{(a.x + b.x) / 2 - (b.y - a.y) * step, (a.y + b.y) / 2 + (b.x - a.x) * step};
    for (Polygon& polygon : model.geometry) {
      if (!contains(polygon.outer, inside)) continue;
      polygon.holes.push_back(std::move(hole));
      break;
    }
  }
  if (model.geometry.empty()) model.reason = "contradictory wedges carved everything away";
  return model;
}

void sort_models(std::vector<ModelResult>& models) {
  constexpr std::array<std::string_view, 9> kOrder{
      "cylinder", "cylinder_paper", "sheaf_paper", "sheaf", "carve_paper", "clip_paper", "carve", "clip", "hybrid"};
  const auto place = [&](const ModelResult& model) { return std::find(kOrder.begin(), kOrder.end(), model.name); };
  std::stable_sort(models.begin(), models.end(), [&](const auto& a, const auto& b) { return place(a) < place(b); });
}

}  // namespace fencepost::host
