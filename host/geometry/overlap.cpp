// The plane is cut into slabs at every vertex and crossing, so that no edges cross inside a slab.
// There a covered width is linear: its area is the width at half height times the height.
#include <algorithm>
#include <cstddef>

#include "host/geometry/planar.hpp"

namespace fencepost::host {
namespace {

struct Edge {
  Point low;
  Point high;
  std::size_t part = 0;  ///< the polygon that it belongs to, of both inputs
  [[nodiscard]] double at(double y) const { return low.x + (high.x - low.x) * ((y - low.y) / (high.y - low.y)); }
};

void add_edges(const LinearRing& ring, std::size_t part, std::vector<Edge>& edges) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point a = ring[i];
    const Point b = ring[(i + 1) % ring.size()];
    if (a.y < b.y) edges.push_back({a, b, part});
    if (b.y < a.y) edges.push_back({b, a, part});
  }
}

/// Adds the crossing of two edges that share a height.
void add_crossing(const Edge& a, const Edge& b, std::vector<double>& heights) {
  const Point u{a.high.x - a.low.x, a.high.y - a.low.y};
  const Point v{b.high.x - b.low.x, b.high.y - b.low.y};
  const Point apart{b.low.x - a.low.x, b.low.y - a.low.y};
  const double turn = u.x * v.y - u.y * v.x;
  if (turn == 0) return;
  const double along_a = (apart.x * v.y - apart.y * v.x) / turn;
  const double along_b = (apart.x * u.y - apart.y * u.x) / turn;
  if (along_a > 0 && along_a < 1 && along_b > 0 && along_b < 1) heights.push_back(a.low.y + along_a * u.y);
}

/// Where slabs begin and end. `edges` are in the order of their lower ends.
std::vector<double> heights_of(const std::vector<Edge>& edges) {
  std::vector<double> heights;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    heights.push_back(edges[i].low.y);
    heights.push_back(edges[i].high.y);
    const auto [left, right] = std::minmax(edges[i].low.x, edges[i].high.x);
    for (std::size_t k = i + 1; k < edges.size() && edges[k].low.y < edges[i].high.y; ++k) {
      const auto [least, most] = std::minmax(edges[k].low.x, edges[k].high.x);
      if (least <= right && most >= left) add_crossing(edges[i], edges[k], heights);
    }
  }
  std::sort(heights.begin(), heights.end());
  heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
  return heights;
}

struct Crossing {
  double x = 0;
  std::size_t part = 0;
};

class Sweep {
 public:
  Sweep(std::size_t parts_of_a, std::size_t parts) : parts_of_a_(parts_of_a), inside_(parts, false) {}

  /// From left to right through one slab; every part is left again at the end.
  void pass(const std::vector<Crossing>& crossings, double height) {
    double x = crossings.empty() ? 0 : crossings.front().x;
    for (const Crossing& crossing : crossings) {
      const double area = (crossing.x - x) * height;
      if (in_a_ > 0 && in_b_ > 0) {
        found_.both += area;
      } else if (in_a_ > 0) {
        found_.only_a += area;
      } else if (in_b_ > 0) {
        found_.only_b += area;
      }
      x = crossing.x;
      std::size_t& count = crossing.part < parts_of_a_ ? in_a_ : in_b_;
      inside_[crossing.part] ? --count : ++count;
      inside_[crossing.part] = !inside_[crossing.part];
    }
  }
  [[nodiscard]] Overlap found() const { return found_; }

 private:
  std::size_t parts_of_a_;
  std::vector<bool> inside_;
  std::size_t in_a_ = 0;
  std::size_t in_b_ = 0;
  Overlap found_;
};

}  // namespace

Overlap overlap(const MultiPolygon& a, const MultiPolygon& b) {
  std::vector<Edge> edges;
  std::size_t part = 0;
  for (const MultiPolygon* areas : {&a, &b}) {
    for (const Polygon& polygon : *areas) {
      add_edges(polygon.outer, part, edges);
      for (const LinearRing& hole : polygon.holes) add_edges(hole, part, edges);
      ++part;
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& one, const Edge& other) { return one.low.y < other.low.y; });
  const std::vector<double> heights = heights_of(edges);
  Sweep sweep(a.size(), part);
  std::vector<const Edge*> active;
  std::vector<Crossing> crossings;
  auto next = edges.begin();
  for (std::size_t i = 0; i + 1 < heights.size(); ++i) {
    std::erase_if(active, [&](const Edge* edge) { return edge->high.y <= heights[i]; });
    for (; next != edges.end() && next->low.y <= heights[i]; ++next) active.push_back(&*next);
    const double middle = heights[i] + (heights[i + 1] - heights[i]) / 2;
    crossings.clear();
    for (const Edge* edge : active) crossings.push_back({edge->at(middle), edge->part});
    std::sort(crossings.begin(), crossings.end(),
              [](const Crossing& one, const Crossing& other) { return one.x < other.x; });
    sweep.pass(crossings, heights[i + 1] - heights[i]);
  }
  return sweep.found();
}

double intersection_area(const MultiPolygon& a, const MultiPolygon& b) { return overlap(a, b).both; }

double union_area(const MultiPolygon& a, const MultiPolygon& b) {
  const Overlap found = overlap(a, b);
  return found.both + found.only_a + found.only_b;
}

double difference_area(const MultiPolygon& a, const MultiPolygon& b) { return overlap(a, b).only_a; }

}  // namespace fencepost::host
