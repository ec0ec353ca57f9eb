#include "host/paper/blocks_world.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "host/geometry/rings.hpp"
#include "host/scene/table_camera.hpp"
#include "host/simulate/random.hpp"

namespace fencepost::host {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRate = 10;  // frames/s
constexpr std::uint8_t kFirstPanel = 10;
constexpr int kTries = 4000;

struct Paint {
  const char* name = "";
  sensor::Rgb rgb;
};
constexpr std::array<Paint, 3> kPaints{{{"red", {200, 40, 40}}, {"yellow", {210, 190, 40}}, {"blue", {40, 70, 190}}}};

enum class Shape : unsigned char { kRectangle, kTriangle, kRound, kEll };

/// Around the origin; `size` is about its largest extent, m.
LinearRing outline_of(Shape shape, double size, Random& random) {
  const double a = size / 2;
  switch (shape) {
    case Shape::kRectangle: {
      const double b = a * random.uniform(0.4, 1);
      return {{-a, -b}, {a, -b}, {a, b}, {-a, b}};
    }
    case Shape::kTriangle: {
      LinearRing ring;
      for (int i = 0; i < 3; ++i) {
        const double angle = 2 * kPi * i / 3 + random.uniform(-0.25, 0.25);
        ring.push_back({size / 1.8 * std::cos(angle), size / 1.8 * std::sin(angle)});
      }
      return ring;
    }
    case Shape::kRound: return circle_ring({0, 0}, a, 48);
    case Shape::kEll: break;
  }
  const double w = size * random.uniform(0.3, 0.45);
  return {{-a, -a}, {a, -a}, {a, -a + w}, {-a + w, -a + w}, {-a + w, a}, {-a, a}};
}

struct Disc {
  Point center;
  double radius = 0;
};

class Builder {
 public:
  Builder(BlocksWorld kind, std::uint64_t seed) : kind_(kind), random_(seed, Purpose::kDetection, 0x626c6f636b73) {
    scene_.seed = seed;
  }

  Scene build(bool noisy) {
    scene_.camera = table_camera("blocks");
    scene_.rate = kRate;
    for (const Paint& paint : kPaints) {
      scene_.signatures.push_back({static_cast<std::uint8_t>(scene_.signatures.size() + 1), paint.name, paint.rgb});
    }
    while (scene_.objects.size() < block_count(kind_)) add_block(scene_.objects.size());
    const int panels = kind_ == BlocksWorld::kHard ? 14 : 8;
    for (int i = 0; i < panels; ++i) add_panel(i);
    set_path();
    if (noisy) set_noise();
    return std::move(scene_);
  }

 private:
  [[nodiscard]] bool figures() const { return kind_ == BlocksWorld::kFigures; }

  Shape shape_of(std::size_t block) {
    if (block == kRedLandmark) return Shape::kRectangle;
    if (block == kYellowLandmark && figures()) return scene_.seed % 2 == 0 ? Shape::kRound : Shape::kRectangle;
    if (block == kYellowLandmark) return Shape::kRound;
    return static_cast<Shape>(random_.below(4));
  }

  std::uint8_t signature_of(std::size_t block) {
    return static_cast<std::uint8_t>(block < kPaints.size() ? block + 1 : random_.below(2) + 1);
  }

  void add_block(std::size_t block) {
    const double disc = figures() ? 0.25 : 0.4;    // m, where blocks stand
    const double apart = figures() ? 0.05 : 0.04;  // m, between the circles around them
    const std::uint8_t signature = signature_of(block);
    const Shape shape = shape_of(block);
    for (int tries = 0; tries < kTries; ++tries) {
      const double size = figures() ? random_.uniform(0.12, 0.2) : random_.uniform(0.08, 0.22);
      const LinearRing outline = outline_of(shape, size, random_);
      const double angle = random_.uniform(0, 2 * kPi);
      const double away = disc * std::sqrt(random_.uniform());
      const Point place{away * std::cos(angle), away * std::sin(angle)};
      double radius = 0;
      for (const Point& p : outline) radius = std::max(radius, std::hypot(p.x, p.y));
      if (!is_free({place, radius}, apart)) continue;
      discs_.push_back({place, radius});
      const std::string name = block < kPaints.size() ? kPaints[block].name : "distractor";
      scene_.objects.push_back({name + " block", signature, 0, random_.uniform(0.16, 0.30),
                                moved({outline, {}}, random_.uniform(0, 2 * kPi), place)});
      return;
    }
  }

  // A thin upright board that faces the blocks, a little above the floor.
  void add_panel(int number) {
    constexpr double kThin = 0.01;
    for (int tries = 0; tries < kTries; ++tries) {
      const double angle = random_.uniform(0, 2 * kPi);
      const double away = random_.uniform(2, 3.5);
      const double half = random_.uniform(0.05, 0.3);
      const double height = random_.uniform(0.15, 0.55);
      const Point place{away * std::cos(angle), away * std::sin(angle)};
      if (!is_free({place, half}, 0.02)) continue;
      discs_.push_back({place, half});
      const auto signature = static_cast<std::uint8_t>(kFirstPanel + number);
      const std::string name = "panel " + std::to_string(number + 1);
      scene_.signatures.push_back({signature, name, panel_colour(number)});
      const Polygon board{{{-kThin, -half}, {kThin, -half}, {kThin, half}, {-kThin, half}}, {}};
      scene_.objects.push_back({name, signature, 0.1, height, moved(board, angle, place)});
      return;
    }
  }

  [[nodiscard]] bool is_free(const Disc& disc, double apart) const {
    return std::none_of(discs_.begin(), discs_.end(), [&](const Disc& other) {
      return std::hypot(other.center.x - disc.center.x, other.center.y - disc.center.y) <
             other.radius + disc.radius + apart;
    });
  }

  sensor::Rgb panel_colour(int number) {
    const auto channel = [](double v) { return static_cast<std::uint8_t>(std::clamp(std::round(v), 0.0, 255.0)); };
    const double base = random_.uniform(70, 190);
    const double shade = random_.uniform(0.6, 0.95);
    const std::array<double, 3> tint{random_.gaussian(), random_.gaussian(), random_.gaussian()};
    const sensor::Rgb landmark = kPaints[random_.below(2)].rgb;
    if (kind_ == BlocksWorld::kHard && number % 3 == 0) {
      return {channel(shade * landmark.red), channel(shade * landmark.green), channel(shade * landmark.blue)};
    }
    constexpr double kTint = 22;
    return {channel(base + kTint * tint[0]), channel(base + kTint * tint[1]), channel(base + kTint * tint[2])};
  }

  void set_path() {
    const double radius = figures() ? 0.95 : random_.uniform(0.9, 1.1);
    const double start = random_.uniform(0, 2 * kPi);
    const double aside = figures() ? 0.05 : 0.15;  // rad, from the way to the centre
    const double sway = figures() ? 0 : 0.35;
    PosesPath path;
    for (int i = 0; i < kPaperViews; ++i) {
      const double angle = start + 2 * kPi * i / kPaperViews;
      const double heading = angle + kPi + random_.uniform(-aside, aside) + sway * std::sin(3 * angle);
      path.poses.push_back({i / kRate, radius * std::cos(angle), radius * std::sin(angle), heading});
    }
    scene_.path = path;
  }

  void set_noise() {
    const bool high = kind_ == BlocksWorld::kHard;
    SceneNoise& noise = scene_.noise;
    noise.edge_px = high ? 2 : 1.5;
    noise.loss_probability = high ? 0.10 : 0.05;
    noise.growth_probability = high ? 0.05 : 0.02;
    noise.growth_max = 0.6;
    noise.miss_probability = high ? 0.05 : 0.02;
    noise.pose_xy = high ? 0.010 : 0.004;
    noise.pose_heading = (high ? 1.0 : 0.4) * kPi / 180;
  }

  BlocksWorld kind_;
  Random random_;
  Scene scene_;
  std::vector<Disc> discs_;
};

}  // namespace

Scene blocks_world(BlocksWorld kind, std::uint64_t seed, bool noisy) { return Builder(kind, seed).build(noisy); }

std::size_t block_count(BlocksWorld kind) {
  switch (kind) {
    case BlocksWorld::kFigures: return 2;
    case BlocksWorld::kPaperLike: return 3;
    case BlocksWorld::kDistractor:
    case BlocksWorld::kHard: break;
  }
  return 4;
}

}  // namespace fencepost::host
