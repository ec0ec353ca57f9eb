// Classifies each colour: one of the signatures, or background.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "firmware/record/records.hpp"
#include "host/segment/colour_clusters.hpp"

namespace fencepost::host {

/// How the background is specified. If nothing is given it is found: the colours that cover most of the images, or much
/// of their borders.
struct BackgroundRule {
  int darkest = 0;                   ///< pixels below this in every channel are background, 0..255
  std::vector<sensor::Rgb> colours;  ///< background, with their shadows
  [[nodiscard]] bool given() const { return darkest > 0 || !colours.empty(); }
};

struct ClassRules {
  BackgroundRule background;
  /// Given: the clusters near one of these belong to it, allowing for light; the rest is background.
  /// Empty: each paint that is no background is a signature, numbered from 1, most pixels first.
  std::vector<record::Signature> signatures;
  bool silhouette = false;  ///< all that is no background is signature 1
};

struct SignatureUse {
  record::Signature signature;
  std::size_t images = 0;  ///< of those that were looked at for colours
};

class ColourClasses {
 public:
  /// `clusters` were found in `images` images.
  ColourClasses(const std::vector<ColourCluster>& clusters, const ClassRules& rules, std::size_t images);

  /// 0: background, n: the n-th of `signatures`. One byte a pixel of the smoothed image.
  [[nodiscard]] cv::Mat labels_of(const cv::Mat& smooth);

  [[nodiscard]] const std::vector<SignatureUse>& signatures() const { return signatures_; }
  /// Colours that were taken for background, largest first.
  [[nodiscard]] const std::vector<sensor::Rgb>& background() const { return background_; }
  /// Colours that were left out since so few images have them.
  [[nodiscard]] const std::vector<sensor::Rgb>& rare() const { return rare_; }

 private:
  struct Prototype {
    Appearance looks;
    std::uint8_t label = 0;
  };
  void match_given(const std::vector<ColourCluster>& clusters, const ClassRules& rules);
  void take_found(const std::vector<ColourCluster>& clusters, const ClassRules& rules, std::size_t images);
  void take_silhouette(const std::vector<ColourCluster>& clusters, const ClassRules& rules);
  void name_signatures();
  void add_background(const ColourCluster& cluster);
  [[nodiscard]] std::uint8_t nearest_label(sensor::Rgb rgb) const;
  std::uint8_t label_of(const cv::Vec3b& bgr);

  std::vector<Prototype> prototypes_;
  std::vector<SignatureUse> signatures_;
  std::vector<sensor::Rgb> background_;
  std::vector<sensor::Rgb> rare_;
  int darkest_;
  bool silhouette_;
  std::vector<int> known_;  ///< label of each colour in steps of 4 grey levels; -1: not asked for yet
};

}  // namespace fencepost::host
