#include <algorithm>
#include <cstddef>
#include <map>
#include <numeric>
#include <utility>

#include "host/geometry/planar.hpp"

namespace fencepost::host {
namespace {

struct Side {
  Point a;
  Point b;
  std::size_t ring = 0;   ///< 0: the outer one
  std::size_t index = 0;  ///< in its ring
  [[nodiscard]] Point middle() const { return {a.x + (b.x - a.x) / 2, a.y + (b.y - a.y) / 2}; }
};

/// The side of c from the line a to b: 1 left, -1 right, 0 on it. Differences of doubles and their products need more
/// digits.
int side_of(Point a, Point b, Point c) {
  const auto ax = static_cast<long double>(a.x);
  const auto ay = static_cast<long double>(a.y);
  const long double turn = (static_cast<long double>(b.x) - ax) * (static_cast<long double>(c.y) - ay) -
                           (static_cast<long double>(b.y) - ay) * (static_cast<long double>(c.x) - ax);
  return turn > 0 ? 1 : turn < 0 ? -1 : 0;
}

bool between(Point p, Point a, Point b) {
  return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}

enum class Meeting { kNone, kTouch, kCross, kAlong };

struct Contact {
  Meeting meeting = Meeting::kNone;
  Point where;
};

Contact contact_of(const Side& s, const Side& t) {
  const int ta = side_of(s.a, s.b, t.a);
  const int tb = side_of(s.a, s.b, t.b);
  const int sa = side_of(t.a, t.b, s.a);
  const int sb = side_of(t.a, t.b, s.b);
  if (ta * tb < 0 && sa * sb < 0) {
    const Point u{s.b.x - s.a.x, s.b.y - s.a.y};
    const Point v{t.b.x - t.a.x, t.b.y - t.a.y};
    const double share = ((t.a.x - s.a.x) * v.y - (t.a.y - s.a.y) * v.x) / (u.x * v.y - u.y * v.x);
    return {Meeting::kCross, {s.a.x + share * u.x, s.a.y + share * u.y}};
  }
  // Ends of one side that lie on the other: one place, or both ends of the common part.
  std::vector<Point> shared;
  const auto add = [&](int side, Point end, const Side& other) {
    if (side == 0 && between(end, other.a, other.b) && std::find(shared.begin(), shared.end(), end) == shared.end()) {
      shared.push_back(end);
    }
  };
  add(ta, t.a, s);
  add(tb, t.b, s);
  add(sa, s.a, t);
  add(sb, s.b, t);
  if (shared.empty()) return {};
  return {shared.size() > 1 ? Meeting::kAlong : Meeting::kTouch, shared.front()};
}

/// Whether rings and the places where they touch form a loop, which cuts the interior in two.
class Chain {
 public:
  explicit Chain(std::size_t rings) : parent_(rings) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }

  /// False if ring and place were joined before by other ways.
  bool join(std::size_t ring, Point place) {
    const auto [known, fresh] = places_.try_emplace({place.x, place.y}, parent_.size());
    if (fresh) parent_.push_back(parent_.size());
    const std::pair link{ring, known->second};
    if (std::find(links_.begin(), links_.end(), link) != links_.end()) return true;
    links_.push_back(link);
    const std::size_t a = root(ring);
    const std::size_t b = root(known->second);
    parent_[a] = b;
    return a != b;
  }

 private:
  std::size_t root(std::size_t i) {
    while (parent_[i] != i) i = parent_[i];
    return i;
  }
  std::vector<std::size_t> parent_;
  std::map<std::pair<double, double>, std::size_t> places_;
  std::vector<std::pair<std::size_t, std::size_t>> links_;
};

class Check {
 public:
  explicit Check(const Polygon& polygon) {
    add(polygon.outer);
    for (const LinearRing& hole : polygon.holes) {
      if (hole.size() >= 3) add(hole);
    }
  }

  std::optional<Invalidity> run() {
    for (const LinearRing& ring : rings_) {
      if (ring.size() < 3) return Invalidity{"Too few points", ring.empty() ? Point{} : ring.front()};
    }
    if (auto invalid = meetings()) return invalid;
    return holes();
  }

 private:
  void add(const LinearRing& ring) {
    LinearRing distinct;
    for (const Point p : ring) {
      if (distinct.empty() || !(distinct.back() == p)) distinct.push_back(p);
    }
    distinct = opened(std::move(distinct));
    for (std::size_t i = 0; i < distinct.size(); ++i) {
      sides_.push_back({distinct[i], distinct[(i + 1) % distinct.size()], rings_.size(), i});
    }
    rings_.push_back(std::move(distinct));
  }

  [[nodiscard]] bool neighbours(const Side& s, const Side& t) const {
    const std::size_t apart = s.index > t.index ? s.index - t.index : t.index - s.index;
    return apart == 1 || apart + 1 == rings_[s.ring].size();
  }

  std::optional<Invalidity> meetings() {
    std::vector<const Side*> order;
    for (const Side& side : sides_) order.push_back(&side);
    std::sort(order.begin(), order.end(), [](const Side* one, const Side* other) {
      return std::min(one->a.y, one->b.y) < std::min(other->a.y, other->b.y);
    });
    for (std::size_t i = 0; i < order.size(); ++i) {
      const double top = std::max(order[i]->a.y, order[i]->b.y);
      for (std::size_t k = i + 1; k < order.size() && std::min(order[k]->a.y, order[k]->b.y) <= top; ++k) {
        if (auto invalid = meeting(*order[i], *order[k])) return invalid;
      }
    }
    return std::nullopt;
  }

  std::optional<Invalidity> meeting(const Side& s, const Side& t) {
    const Contact contact = contact_of(s, t);
    if (contact.meeting == Meeting::kNone) return std::nullopt;
    if (contact.meeting != Meeting::kTouch) return Invalidity{"Self-intersection", contact.where};
    if (s.ring == t.ring) {
      if (neighbours(s, t)) return std::nullopt;
      return Invalidity{"Ring Self-intersection", contact.where};
    }
    const bool apart = chain().join(s.ring, contact.where);
    if (chain().join(t.ring, contact.where) && apart) return std::nullopt;
    return Invalidity{"Interior is disconnected", contact.where};
  }

  /// No sides cross: a hole is in a ring as a whole, or out of it.
  [[nodiscard]] std::optional<Invalidity> holes() const {
    for (const Side& side : sides_) {
      if (side.ring == 0) continue;
      if (!contains({rings_[0], {}}, side.middle())) return Invalidity{"Hole lies outside shell", side.a};
      for (std::size_t i = 1; i < rings_.size(); ++i) {
        if (i != side.ring && contains({rings_[i], {}}, side.middle())) return Invalidity{"Holes are nested", side.a};
      }
    }
    return std::nullopt;
  }

  Chain& chain() {
    if (!chain_) chain_.emplace(rings_.size());
    return *chain_;
  }

  std::vector<LinearRing> rings_;
  std::vector<Side> sides_;
  std::optional<Chain> chain_;
};

}  // namespace

std::optional<Invalidity> find_invalidity(const Polygon& polygon) {
  if (auto invalid = Check(polygon).run()) return invalid;
  if (!(area(polygon) > 0)) return Invalidity{"No area", polygon.outer.front()};
  return std::nullopt;
}

}  // namespace fencepost::host
