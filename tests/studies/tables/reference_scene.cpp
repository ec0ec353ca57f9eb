#include "tests/studies/tables/reference_scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "host/geometry/rings.hpp"
#include "host/scene/table_camera.hpp"

namespace fencepost::test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSmallest = 0.06;   // m
constexpr double kApart = 0.03;      // m between the circles around two objects
constexpr double kHeight = 0.2;      // m, more than the lens has
constexpr double kLookAside = 0.05;  // rad

class Dice {
 public:
  explicit Dice(unsigned seed) : random_(seed) {}
  double between(double a, double b) { return a + (b - a) * (static_cast<double>(random_()) / 4294967296.0); }
  unsigned below(unsigned n) { return static_cast<unsigned>(random_()) % n; }

 private:
  std::mt19937 random_;
};

enum Shape : unsigned { kRectangle, kTriangle, kRound, kElbow };

host::LinearRing footprint(Dice& dice, unsigned shape, double size) {
  const double a = size / 2;
  host::LinearRing ring;
  switch (shape) {
    case kRectangle: {
      const double b = a * dice.between(0.4, 1);
      return {{-a, -b}, {a, -b}, {a, b}, {-a, b}};
    }
    case kTriangle:
      for (int i = 0; i < 3; ++i) {
        const double angle = 2 * kPi * i / 3 + dice.between(-0.25, 0.25);
        ring.push_back({size / 1.8 * std::cos(angle), size / 1.8 * std::sin(angle)});
      }
      return ring;
    case kRound:
      for (int i = 0; i < 40; ++i) ring.push_back({a * std::cos(2 * kPi * i / 40), a * std::sin(2 * kPi * i / 40)});
      return ring;
    default: {
      const double w = size * dice.between(0.3, 0.45);
      return {{-a, -a}, {a, -a}, {a, -a + w}, {-a + w, -a + w}, {-a + w, a}, {-a, a}};
    }
  }
}

struct Disc {
  host::Point center;
  double radius = 0;
};

/// Around the mean of the vertices.
Disc disc_of(const host::LinearRing& ring) {
  Disc disc;
  for (const host::Point& p : ring) {
    disc.center.x += p.x / static_cast<double>(ring.size());
    disc.center.y += p.y / static_cast<double>(ring.size());
  }
  for (const host::Point& p : ring) {
    disc.radius = std::max(disc.radius, std::hypot(p.x - disc.center.x, p.y - disc.center.y));
  }
  return disc;
}

// Puts the ring into a disc around the origin, clear of what is there. False: there is no room this time.
bool place(Dice& dice, const host::LinearRing& ring, double disc_radius, std::vector<Disc>& placed,
           host::Scene& scene) {
  const double angle = dice.between(0, 2 * kPi);
  const double away = disc_radius * std::sqrt(dice.between(0, 1));
  const double turn = dice.between(0, 2 * kPi);
  const host::Polygon footprint = host::moved({ring, {}}, turn, {away * std::cos(angle), away * std::sin(angle)});
  const Disc disc = disc_of(footprint.outer);
  const bool free = std::none_of(placed.begin(), placed.end(), [&](const Disc& other) {
    return std::hypot(other.center.x - disc.center.x, other.center.y - disc.center.y) <
           other.radius + disc.radius + kApart;
  });
  if (!free) return false;
  placed.push_back(disc);
  const auto signature = static_cast<std::uint8_t>(placed.size());
  const std::string number = std::to_string(placed.size());
  scene.signatures.push_back({signature, "colour " + number, {200, 40, 40}});
  scene.objects.push_back({"object " + number, signature, 0, kHeight, footprint});
  return true;
}

void add_objects(Dice& dice, std::size_t count, double largest, double disc, host::Scene& scene) {
  std::vector<Disc> placed;
  for (int tries = 0; placed.size() < count && tries < 2000; ++tries) {
    const unsigned shape = dice.below(4);
    const double size = dice.between(kSmallest, largest);
    static_cast<void>(place(dice, footprint(dice, shape, size), disc, placed, scene));
  }
}

void add_two_convex(Dice& dice, unsigned seed, host::Scene& scene) {
  constexpr double kSmallDisc = 0.25;
  std::vector<Disc> placed;
  for (int tries = 0; placed.size() < 2 && tries < 2000; ++tries) {
    const Shape shape = placed.empty() || seed % 2 == 1 ? kRectangle : kRound;
    const double size = dice.between(0.12, 0.2);
    static_cast<void>(place(dice, footprint(dice, shape, size), kSmallDisc, placed, scene));
  }
}

/// View i of the tour comes i * `stride` steps after the first, modulo the circle.
void set_path(Dice& dice, double radius, int stride, host::Scene& scene) {
  const double start = dice.between(0, 2 * kPi);
  scene.rate = 10;
  host::PosesPath path;
  for (int i = 0; i < kTourViews; ++i) {
    const double angle = start + 2 * kPi * (i * stride % kTourViews) / kTourViews;
    path.poses.push_back({i / scene.rate, radius * std::cos(angle), radius * std::sin(angle),
                          angle + kPi + dice.between(-kLookAside, kLookAside)});
  }
  scene.path = path;
}

host::Scene three_objects(unsigned seed, Dice& dice) {
  host::Scene scene;
  scene.seed = seed;
  scene.camera = host::table_camera("test");
  add_objects(dice, 3, 0.26, 0.35, scene);
  return scene;
}

host::Scene circled(unsigned seed, int stride) {
  Dice dice(seed);
  host::Scene scene = three_objects(seed, dice);
  set_path(dice, dice.between(0.8, 1.1), stride, scene);
  return scene;
}

// Ovals, the camera looking to the left and now and then aside.
void set_loops(Dice& dice, int loops, host::Scene& scene) {
  const double radius = dice.between(0.95, 1.2);
  const double start = dice.between(0, 2 * kPi);
  scene.rate = 10;
  scene.camera.mount.yaw = base::Radians::nearest(kPi / 2);
  host::PosesPath path;
  for (int i = 0; i < kTourViews * loops; ++i) {
    const double angle = start + 2 * kPi * i / kTourViews;
    const double away = radius * (1 + 0.12 * std::sin(2 * angle + 1));
    path.poses.push_back(
        {i / scene.rate, away * std::cos(angle), away * std::sin(angle), angle + kPi / 2 + 0.15 * std::sin(3 * angle)});
  }
  scene.path = path;
}

}  // namespace

host::Scene loop_scene(unsigned seed, int loops) {
  Dice dice(seed);
  host::Scene scene;
  scene.seed = seed;
  scene.camera = host::table_camera("test");
  add_objects(dice, 4, 0.24, 0.45, scene);
  set_loops(dice, loops, scene);
  return scene;
}

host::Scene reference_scene(unsigned seed) { return circled(seed, 1); }

host::Scene spread_scene(unsigned seed) {
  constexpr int kStride = 29;
  return circled(seed, kStride);
}

host::Scene objects_of_reference(unsigned seed) {
  Dice dice(seed);
  return three_objects(seed, dice);
}

host::Scene two_objects_scene(unsigned seed) {
  constexpr double kRadius = 0.95;
  Dice dice(seed);
  host::Scene scene;
  scene.seed = seed;
  scene.camera = host::table_camera("test");
  add_two_convex(dice, seed, scene);
  set_path(dice, kRadius, 1, scene);
  return scene;
}

}  // namespace fencepost::test
