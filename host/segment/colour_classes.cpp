#include "host/segment/colour_classes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace fencepost::host {

namespace {

constexpr double kSame = kSameColour * kSameColour;  // squared, as all distances here
constexpr double kGivenReach = 0.3 * 0.3;            // a given colour is a guess at what the light made of it
constexpr double kFarthest = 0.25 * 0.25;            // from its prototype a pixel still belongs to a signature
constexpr std::size_t kMaxSignatures = 255;
constexpr std::size_t kLevels = 4;  // grey levels that no class can distinguish
constexpr std::size_t kSteps = 256 / kLevels;

/// The same colour in less light, or in slightly more. Saturated colours are one class in any light anyway.
bool is_shade_of(const Appearance& shade, const Appearance& of) {
  constexpr double kLighter = 0.3;  // of 0.8 from black to white
  return squared_hue_distance(shade, of) < kSame && shade.z < of.z + kLighter;
}

/// Saturated colours of one hue: one paint, from its brightest to its darkest side.
bool is_same_paint(const Appearance& a, const Appearance& b) {
  constexpr double kStrong = 0.4;
  constexpr double kCosine = 0.97;  // of 14 degrees of hue
  const double length = std::hypot(a.x, a.y) * std::hypot(b.x, b.y);
  return length > kStrong * kStrong && a.x * b.x + a.y * b.y > kCosine * length;
}

/// Which clusters are background when none is given: the largest, all that take a tenth of the images' borders, and
/// shades of both.
std::vector<bool> found_background(const std::vector<ColourCluster>& clusters) {
  constexpr double kBorderShare = 0.1;
  double border = 0;
  for (const ColourCluster& cluster : clusters) border += cluster.border_pixels;
  std::vector<bool> background(clusters.size());
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    background[i] = i == 0 || clusters[i].border_pixels > kBorderShare * border;
  }
  std::vector<bool> with_shades = background;
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    for (std::size_t b = 0; b < clusters.size(); ++b) {
      if (background[b] && is_shade_of(clusters[i].looks, clusters[b].looks)) with_shades[i] = true;
    }
  }
  return with_shades;
}

std::vector<bool> background_of(const std::vector<ColourCluster>& clusters, const BackgroundRule& rule) {
  if (!rule.given()) return found_background(clusters);
  std::vector<bool> background(clusters.size());
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    background[i] = std::any_of(rule.colours.begin(), rule.colours.end(),
                                [&](sensor::Rgb colour) { return is_shade_of(clusters[i].looks, appearance(colour)); });
  }
  return background;
}

}  // namespace

ColourClasses::ColourClasses(const std::vector<ColourCluster>& clusters, const ClassRules& rules, std::size_t images)
    : darkest_(rules.background.darkest), silhouette_(rules.silhouette), known_(kSteps * kSteps * kSteps, -1) {
  for (const sensor::Rgb colour : rules.background.colours) prototypes_.push_back({appearance(colour), 0});
  if (rules.silhouette) {
    take_silhouette(clusters, rules);
  } else if (!rules.signatures.empty()) {
    match_given(clusters, rules);
  } else {
    take_found(clusters, rules, images);
  }
}

void ColourClasses::add_background(const ColourCluster& cluster) {
  prototypes_.push_back({cluster.looks, 0});
  background_.push_back(cluster.rgb);
}

void ColourClasses::match_given(const std::vector<ColourCluster>& clusters, const ClassRules& rules) {
  for (const record::Signature& signature : rules.signatures) signatures_.push_back({signature, 0});
  for (const ColourCluster& cluster : clusters) {
    std::size_t best = 0;
    double distance = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < rules.signatures.size(); ++i) {
      const double to_this = squared_distance(cluster.looks, appearance(rules.signatures[i].rgb));
      if (to_this < distance) {
        best = i;
        distance = to_this;
      }
    }
    const auto nearer = [&](sensor::Rgb colour) {
      return squared_distance(cluster.looks, appearance(colour)) < distance;
    };
    const auto& given = rules.background.colours;
    if (distance > kGivenReach || std::any_of(given.begin(), given.end(), nearer)) {
      add_background(cluster);
      continue;
    }
    prototypes_.push_back({cluster.looks, static_cast<std::uint8_t>(best + 1)});
    signatures_[best].images = std::max(signatures_[best].images, cluster.images);
  }
  // Too small everywhere for a cluster of its own: its given colour is used.
  for (std::size_t i = 0; i < signatures_.size(); ++i) {
    if (signatures_[i].images > 0) continue;
    prototypes_.push_back({appearance(signatures_[i].signature.rgb), static_cast<std::uint8_t>(i + 1)});
  }
}

void ColourClasses::take_found(const std::vector<ColourCluster>& clusters, const ClassRules& rules,
                               std::size_t images) {
  const std::size_t fewest = images < 2 ? 1 : std::max<std::size_t>(2, images / 10);
  const std::vector<bool> background = background_of(clusters, rules.background);
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    const ColourCluster& cluster = clusters[i];
    const auto paint = std::find_if(signatures_.begin(), signatures_.end(), [&](const SignatureUse& use) {
      return is_same_paint(cluster.looks, appearance(use.signature.rgb));
    });
    if (background[i]) {
      add_background(cluster);
    } else if (paint != signatures_.end()) {
      prototypes_.push_back({cluster.looks, paint->signature.signature});
      paint->images = std::max(paint->images, cluster.images);
    } else if (cluster.images < fewest || signatures_.size() == kMaxSignatures) {
      prototypes_.push_back({cluster.looks, 0});
      rare_.push_back(cluster.rgb);
    } else {
      record::Signature signature;
      signature.signature = static_cast<std::uint8_t>(signatures_.size() + 1);
      signature.rgb = cluster.rgb;
      signatures_.push_back({signature, cluster.images});
      prototypes_.push_back({cluster.looks, signature.signature});
    }
  }
  name_signatures();
}

void ColourClasses::take_silhouette(const std::vector<ColourCluster>& clusters, const ClassRules& rules) {
  const std::vector<bool> background = background_of(clusters, rules.background);
  record::Signature signature{1, {0xa0, 0xa0, 0xa0}, "silhouette"};
  if (!rules.signatures.empty()) signature = rules.signatures.front();
  signatures_.push_back({signature, 0});
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    if (background[i]) {
      add_background(clusters[i]);
      continue;
    }
    prototypes_.push_back({clusters[i].looks, 1});
    signatures_[0].images = std::max(signatures_[0].images, clusters[i].images);
  }
}

void ColourClasses::name_signatures() {
  std::map<std::string, int> used;
  for (SignatureUse& use : signatures_) {
    const std::string name = colour_name(use.signature.rgb);
    const int count = ++used[name];
    use.signature.name = sensor::Text(count == 1 ? name : name + " " + std::to_string(count));
  }
}

std::uint8_t ColourClasses::nearest_label(sensor::Rgb rgb) const {
  const Appearance looks = appearance(rgb);
  double distance = silhouette_ ? std::numeric_limits<double>::infinity() : kFarthest;
  std::uint8_t label = silhouette_ ? 1 : 0;
  for (const Prototype& prototype : prototypes_) {
    const double to_this = squared_distance(looks, prototype.looks);
    if (to_this >= distance) continue;
    distance = to_this;
    label = prototype.label;
  }
  return label;
}

std::uint8_t ColourClasses::label_of(const cv::Vec3b& bgr) {
  const std::size_t index = (bgr[2] / kLevels * kSteps + bgr[1] / kLevels) * kSteps + bgr[0] / kLevels;
  if (known_[index] < 0) {
    const auto middle = [](std::uint8_t level) {
      return static_cast<std::uint8_t>(level / kLevels * kLevels + kLevels / 2);
    };
    known_[index] = nearest_label({middle(bgr[2]), middle(bgr[1]), middle(bgr[0])});
  }
  return static_cast<std::uint8_t>(known_[index]);
}

cv::Mat ColourClasses::labels_of(const cv::Mat& smooth) {
  cv::Mat labels(smooth.rows, smooth.cols, CV_8U);
  for (int v = 0; v < smooth.rows; ++v) {
    const auto* colour = smooth.ptr<cv::Vec3b>(v);
    auto* label = labels.ptr<std::uint8_t>(v);
    for (int u = 0; u < smooth.cols; ++u) {
      const bool dark = std::max({colour[u][0], colour[u][1], colour[u][2]}) < darkest_;
      label[u] = dark ? 0 : label_of(colour[u]);
    }
  }
  return labels;
}

}  // namespace fencepost::host
