#include "host/video/colour_training.hpp"

#include <algorithm>
#include <array>

namespace fencepost::host {
namespace {

using segmenter::ColourRange;

/// Minimum mean of red, green and blue: one level of noise is a share of 1/48 there.
constexpr int kMinBrightness = 16;
/// Factor by which light may fall.
constexpr int kLightFalls = 4;
/// Share of a box that may show something else, at each end of a range.
constexpr double kOutliers = 0.02;
/// Cells of a histogram to a share of 1.
constexpr int kCells = 128;
/// A range grows by at most 0.06: bulbs for daylight, after the camera's white balance, move shares by about as much.
constexpr int kMaxGrowth = 8;
/// Width, px, of blurred edges around the pixels connected to a box: they count for neither side.
constexpr int kEdge = 4;
/// Share of a picture that is noise.
constexpr double kNoise = 0.0002;

using Mask = std::vector<bool>;

int brightness(sensor::Rgb rgb) { return (rgb.red + rgb.green + rgb.blue) / 3; }
int cell(int part, int sum) { return std::min(kCells - 1, part * kCells / sum); }

struct Shares {
  int red = 0;  ///< cells
  int green = 0;
};
Shares shares_of(sensor::Rgb rgb) {
  const int sum = std::max(1, rgb.red + rgb.green + rgb.blue);
  return {cell(rgb.red, sum), cell(rgb.green, sum)};
}

/// Cells of both shares, inclusive.
struct Bounds {
  int red_min = 0;
  int red_max = 0;
  int green_min = 0;
  int green_max = 0;

  [[nodiscard]] bool holds(Shares at) const {
    return at.red >= red_min && at.red <= red_max && at.green >= green_min && at.green <= green_max;
  }
};

/// The value below which a share `part` of the sorted ones lies.
int quantile(const std::vector<int>& sorted, double part) {
  return sorted[static_cast<std::size_t>(part * static_cast<double>(sorted.size() - 1) + 0.5)];
}

class Training {
 public:
  Training(const RgbPicture& picture, std::span<const TrainingBox> boxes, std::uint8_t signature)
      : picture_(picture), signature_(signature), in_box_(picture.pixels.size()), object_(picture.pixels.size()) {
    for (const TrainingBox& box : boxes) {
      if (box.signature != signature) continue;
      for (int v = box.y; v < box.y + box.height; ++v) {
        for (int u = box.x; u < box.x + box.width; ++u) in_box_[index(u, v)] = true;
      }
    }
  }

  TrainedColour run() {
    find_core();
    find_object();
    grow();
    TrainedColour trained{range(), mean_, 0, 0};
    std::size_t found = 0;
    std::size_t all = 0;
    for (std::size_t i = 0; i < picture_.pixels.size(); ++i) {
      const sensor::Rgb rgb = picture_.pixels[i];
      const bool is_it = segmenter::signature_of({&trained.range, 1}, rgb.red, rgb.green, rgb.blue) != 0;
      all += in_box_[i] ? 1U : 0U;
      found += in_box_[i] && is_it ? 1U : 0U;
      trained.elsewhere += !in_box_[i] && !object_[i] && is_it ? 1U : 0U;
    }
    trained.found = static_cast<double>(found) / static_cast<double>(std::max<std::size_t>(1, all));
    return trained;
  }

 private:
  [[nodiscard]] std::size_t index(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(picture_.width) + static_cast<std::size_t>(u);
  }

  /// The range of the boxes' colours without outliers. Pixels that are too dark have no shares.
  void find_core() {
    std::vector<int> red;
    std::vector<int> green;
    std::vector<int> light;
    std::array<std::size_t, 3> sums{};
    for (std::size_t i = 0; i < in_box_.size(); ++i) {
      if (!in_box_[i]) continue;
      const sensor::Rgb rgb = picture_.pixels[i];
      sums[0] += rgb.red;
      sums[1] += rgb.green;
      sums[2] += rgb.blue;
      light.push_back(brightness(rgb));
      if (light.back() < kMinBrightness) continue;
      red.push_back(shares_of(rgb).red);
      green.push_back(shares_of(rgb).green);
    }
    const auto mean = [&](std::size_t sum) {
      return static_cast<std::uint8_t>(sum / std::max<std::size_t>(1, light.size()));
    };
    mean_ = {mean(sums[0]), mean(sums[1]), mean(sums[2])};
    if (red.empty()) {
      red = green = {0};  // black: a range that holds nothing
      light = {255 * kLightFalls};
    }
    for (std::vector<int>* values : {&red, &green, &light}) std::sort(values->begin(), values->end());
    bounds_ = {quantile(red, kOutliers), quantile(red, 1 - kOutliers), quantile(green, kOutliers),
               quantile(green, 1 - kOutliers)};
    darkest_ = std::clamp(quantile(light, kOutliers) / kLightFalls, kMinBrightness, 255);
  }

  /// All that is connected to a box by colours of the core, and its edge.
  void find_object() {
    Mask reached = in_box_;
    std::vector<std::pair<int, int>> open;
    for (int v = 0; v < picture_.height; ++v) {
      for (int u = 0; u < picture_.width; ++u) {
        if (in_box_[index(u, v)]) open.emplace_back(u, v);
      }
    }
    const auto visit = [&](int u, int v) {
      if (u < 0 || v < 0 || u >= picture_.width || v >= picture_.height || reached[index(u, v)]) return;
      if (!bounds_.holds(shares_of(picture_.at(u, v)))) return;
      reached[index(u, v)] = true;
      open.emplace_back(u, v);
    };
    while (!open.empty()) {
      const auto [u, v] = open.back();
      open.pop_back();
      mark_around(u, v);
      for (const int step : {-1, 1}) {
        visit(u + step, v);
        visit(u, v + step);
      }
    }
  }
  void mark_around(int u, int v) {
    for (int y = std::max(0, v - kEdge); y <= std::min(picture_.height - 1, v + kEdge); ++y) {
      for (int x = std::max(0, u - kEdge); x <= std::min(picture_.width - 1, u + kEdge); ++x)
        object_[index(x, y)] = true;
    }
  }

  /// A side stops where the picture has something else of that colour, and goes back half of its way.
  void grow() {
    std::vector<std::uint32_t> others(std::size_t{kCells} * kCells);
    for (std::size_t i = 0; i < object_.size(); ++i) {
      const sensor::Rgb rgb = picture_.pixels[i];
      if (object_[i] || brightness(rgb) < darkest_) continue;
      const Shares at = shares_of(rgb);
      ++others[static_cast<std::size_t>(at.red * kCells + at.green)];
    }
    const auto within = [&](const Bounds& strip) {
      std::uint32_t sum = 0;
      for (int r = strip.red_min; r <= strip.red_max; ++r) {
        for (int g = strip.green_min; g <= strip.green_max; ++g)
          sum += others[static_cast<std::size_t>(r * kCells + g)];
      }
      return sum;
    };
    const auto noise = static_cast<std::uint32_t>(kNoise * static_cast<double>(picture_.pixels.size()));
    const Bounds core = bounds_;
    constexpr int Bounds::*kSides[] = {&Bounds::red_min, &Bounds::red_max, &Bounds::green_min, &Bounds::green_max};
    std::array<bool, 4> stopped{};
    for (int step = 0; step < kMaxGrowth; ++step) {
      for (std::size_t side = 0; side < 4; ++side) {
        if (stopped[side]) continue;
        const int next = bounds_.*kSides[side] + (side % 2 == 0 ? -1 : 1);
        Bounds strip = bounds_;
        const std::size_t low = side / 2 * 2;
        strip.*kSides[low] = strip.*kSides[low + 1] = next;
        stopped[side] = next < 0 || next >= kCells || within(strip) > noise;
        if (!stopped[side]) bounds_.*kSides[side] = next;
      }
    }
    for (std::size_t side = 0; side < 4; ++side) {
      if (stopped[side]) bounds_.*kSides[side] = (bounds_.*kSides[side] + core.*kSides[side]) / 2;
    }
  }

  [[nodiscard]] ColourRange range() const {
    const auto share = [](int cells) { return base::Ratio4::nearest(static_cast<double>(cells) / kCells); };
    return {signature_,
            share(bounds_.red_min),
            share(bounds_.red_max + 1),
            share(bounds_.green_min),
            share(bounds_.green_max + 1),
            static_cast<std::uint8_t>(darkest_),
            255};
  }

  const RgbPicture& picture_;
  std::uint8_t signature_;
  Mask in_box_;
  Mask object_;  ///< with its edge
  Bounds bounds_;
  int darkest_ = 0;
  sensor::Rgb mean_;
};

}  // namespace

std::vector<TrainedColour> train_colours(const RgbPicture& picture, std::span<const TrainingBox> boxes) {
  std::vector<TrainedColour> all;
  for (const TrainingBox& box : boxes) {
    const auto same = [&](const TrainedColour& one) { return one.range.signature == box.signature; };
    if (std::any_of(all.begin(), all.end(), same)) continue;
    all.push_back(Training(picture, boxes, box.signature).run());
  }
  return all;
}

}  // namespace fencepost::host
