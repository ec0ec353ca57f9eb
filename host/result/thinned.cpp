#include "host/result/thinned.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

namespace fencepost::host {
namespace {

constexpr double kTurn = 0.02;      // rad
constexpr double kWidth = 4096;     // resolution of a picture
constexpr double kMinExtent = 0.1;  // m

double turn(double from, double to) { return std::remainder(to - from, 2 * std::numbers::pi); }

/// Whether a drive from `a` to `b` passes `pose` at its time.
bool passes(const PoseResult& a, const PoseResult& b, const PoseResult& pose, double tolerance) {
  const double share = b.t > a.t ? (pose.t - a.t) / (b.t - a.t) : 0;
  const double x = a.x + share * (b.x - a.x);
  const double y = a.y + share * (b.y - a.y);
  const double heading = a.heading + share * turn(a.heading, b.heading);
  return std::hypot(pose.x - x, pose.y - y) <= tolerance && std::abs(turn(heading, pose.heading)) <= kTurn;
}

using Index = std::vector<PoseResult>::const_iterator;

// Halves by number: each level looks at every pose once, whatever the drive.
void keep_between(Index first, Index last, double tolerance, std::vector<PoseResult>& kept) {
  struct Piece {
    Index first, last;
  };
  std::vector<Piece> waiting = {{first, last}};
  while (!waiting.empty()) {
    const Piece piece = waiting.back();
    waiting.pop_back();
    const auto between = [&](const PoseResult& pose) { return passes(*piece.first, *piece.last, pose, tolerance); };
    if (piece.last - piece.first < 2 || std::all_of(piece.first + 1, piece.last, between)) {
      kept.push_back(*piece.last);
      continue;
    }
    const Index middle = piece.first + (piece.last - piece.first) / 2;
    waiting.push_back({middle, piece.last});
    waiting.push_back({piece.first, middle});
  }
}

double extent_of(const std::vector<PoseResult>& path) {
  const auto [left, right] = std::ranges::minmax(path, {}, &PoseResult::x);
  const auto [low, high] = std::ranges::minmax(path, {}, &PoseResult::y);
  return std::max({right.x - left.x, high.y - low.y, kMinExtent});
}

using record::AlertReport;

struct Numbered {
  AlertReport alert;
  std::uint64_t number = 0;
};

bool worse(const AlertReport& a, const AlertReport& b) {
  return a.level != b.level ? a.level > b.level : a.has_place() && (!b.has_place() || a.distance < b.distance);
}

struct Whole {
  std::uint64_t count = 0;
  std::uint64_t stops = 0;
  double begin = 0;
  double end = 0;
  std::optional<Numbered> nearest;
};

Whole whole_of(const EachAlert& each) {
  Whole whole;
  each([&](const AlertReport& alert) {
    const double t = alert.t.to_double();
    if (whole.count == 0) whole.begin = t;
    whole.begin = std::min(whole.begin, t);
    whole.end = std::max(whole.end, t);
    if (alert.level == record::AlertLevel::kStop) ++whole.stops;
    const bool nearer = alert.has_place() && (!whole.nearest || alert.distance < whole.nearest->alert.distance);
    if (nearer) whole.nearest = Numbered{alert, whole.count};
    ++whole.count;
  });
  return whole;
}

/// The alerts that remain with cells of `cell` s; nothing if they are more than `most`.
std::optional<std::vector<Numbered>> thinned(const EachAlert& each, double begin, double cell, bool by_object,
                                             std::size_t most) {
  struct Cell {
    double number = 0;
    Numbered worst;
    Numbered last;
  };
  std::map<std::uint32_t, Cell> cells;
  std::vector<Numbered> kept;
  std::uint64_t number = 0;
  const auto close = [&](const Cell& done) {
    kept.push_back(done.worst);
    if (done.last.alert.level != done.worst.alert.level) kept.push_back(done.last);
  };
  each([&](const AlertReport& alert) {
    const Numbered next{alert, number++};
    if (kept.size() + cells.size() > most) return;
    const double at = cell > 0 ? std::floor((alert.t.to_double() - begin) / cell) : 0;
    const auto [found, first] = cells.try_emplace(by_object ? alert.id : 0, Cell{at, next, next});
    if (first) return;
    Cell& old = found->second;
    if (old.number != at) {
      close(old);
      old = {at, next, next};
    }
    if (worse(alert, old.worst.alert)) old.worst = next;
    old.last = next;
  });
  for (const auto& [id, last] : cells) close(last);
  if (kept.size() > most) return std::nullopt;
  return kept;
}

}  // namespace

std::vector<PoseResult> thin_path(const std::vector<PoseResult>& path, double tolerance) {
  if (path.size() < 3) return path;
  std::vector<PoseResult> kept = {path.front()};
  keep_between(path.begin(), path.end() - 1, tolerance, kept);
  return kept;
}

std::vector<PoseResult> thin_path_to(const std::vector<PoseResult>& path, std::size_t most) {
  if (path.size() < 3) return path;
  for (double tolerance = extent_of(path) / kWidth;; tolerance *= 2) {
    std::vector<PoseResult> kept = thin_path(path, tolerance);
    if (kept.size() <= most) return kept;
    if (tolerance < extent_of(path)) continue;
    // It turns on the spot: every n-th.
    const std::size_t step = (kept.size() + most - 2) / (most - 1);
    std::vector<PoseResult> some;
    for (std::size_t i = 0; i + 1 < kept.size(); i += step) some.push_back(kept[i]);
    some.push_back(kept.back());
    return some;
  }
}

ThinnedAlerts thin_alerts(const EachAlert& each, std::size_t most) {
  const Whole whole = whole_of(each);
  ThinnedAlerts result{{}, whole.count, whole.stops};
  if (whole.count <= most) {
    each([&](const AlertReport& alert) { result.kept.push_back(alert); });
    return result;
  }
  const double duration = whole.end - whole.begin;
  const std::size_t room = most - 1;  // beside the nearest
  std::optional<std::vector<Numbered>> kept;
  for (double cell = duration / kWidth; !kept && cell > 0 && cell < duration; cell *= 2) {
    kept = thinned(each, whole.begin, cell, true, room);
  }
  // Too many objects: whichever of them is worst.
  const double widest = 2.01 * duration / static_cast<double>(room - 2);
  if (!kept) kept = thinned(each, whole.begin, widest, false, room);
  if (!kept) kept.emplace();  // their times go to and fro
  const auto nearest = [&](const Numbered& one) { return one.number == whole.nearest->number; };
  if (whole.nearest && std::ranges::none_of(*kept, nearest)) kept->push_back(*whole.nearest);
  std::ranges::sort(*kept, {}, &Numbered::number);
  for (const Numbered& one : *kept) result.kept.push_back(one.alert);
  return result;
}

}  // namespace fencepost::host
