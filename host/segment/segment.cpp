#include "host/segment/segment.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "host/import/log_builder.hpp"
#include "host/segment/labelled_image.hpp"

namespace fencepost::host {

namespace {

constexpr std::size_t kColourViews = 24;

struct Prepared {
  cv::Mat image;   ///< straightened
  cv::Mat smooth;  ///< the same after the mean shift
};

std::string size_text(int width, int height) { return std::to_string(width) + " x " + std::to_string(height); }

/// Odometry at each exposure, and often enough in between that no reader sees a gap.
std::vector<sensor::OdometrySample> odometry_of(const std::vector<View>& views) {
  constexpr double kLongest = 0.4;  // s; from 0.5 s on it is a gap
  std::vector<sensor::OdometrySample> samples;
  const auto add = [&](double t, double x, double y, double heading) {
    samples.push_back(
        {base::Time::nearest(t), base::Metres::nearest(x), base::Metres::nearest(y), base::Radians::nearest(heading)});
  };
  for (std::size_t i = 0; i < views.size(); ++i) {
    const TimedPose& pose = views[i].pose;
    if (i > 0) {
      const TimedPose& last = views[i - 1].pose;
      const double turn = std::remainder(pose.heading - last.heading, 2 * std::numbers::pi);
      const int steps = static_cast<int>(std::ceil((pose.t - last.t) / kLongest));
      for (int k = 1; k < steps; ++k) {
        const double share = static_cast<double>(k) / steps;
        add(last.t + share * (pose.t - last.t), last.x + share * (pose.x - last.x), last.y + share * (pose.y - last.y),
            last.heading + share * turn);
      }
    }
    add(pose.t, pose.x, pose.y, pose.heading);
  }
  return samples;
}

/// One set of images on its way through both passes.
class Segmentation {
 public:
  Segmentation(const std::vector<View>& views, const sensor::CameraIntrinsics& camera, const SegmentOptions& options,
               const SegmentHooks& hooks)
      : views_(views), files_(camera), options_(options), hooks_(hooks), straighten_(camera, options.straightening) {
    const sensor::CameraIntrinsics& upright = straighten_.camera();
    constexpr double kSpatialShare = 1.0 / 64;  // of the width
    constexpr double kMinSpatial = 3;
    constexpr double kMaxSpatial = 10;
    spatial_ =
        options.spatial.value_or(std::clamp(std::round(upright.width * kSpatialShare), kMinSpatial, kMaxSpatial));
    constexpr double kAreaShare = 0.0005;
    constexpr int kMinPixels = 12;
    const int of_area = static_cast<int>(kAreaShare * upright.width * upright.height);
    rules_.min_pixels = options.min_pixels.value_or(std::max(kMinPixels, of_area));
    constexpr int kGapShare = 100;  // of the width
    rules_.max_gap = options.max_gap.value_or(std::max(2, upright.width / kGapShare));
    constexpr int kBorderShare = 160;
    rules_.border = options.border.value_or(std::max(2, upright.width / kBorderShare));
  }

  Segmented run() {
    const std::size_t looked_at = std::min(views_.size(), kColourViews);
    steps_ = views_.size() + looked_at;
    ColourClasses classes(look_for_colours(looked_at), options_.classes, looked_at);
    result_.summary.signatures = classes.signatures();
    result_.summary.background = classes.background();
    result_.summary.rare = classes.rare();
    for (SignatureUse& use : result_.summary.signatures) use.images = 0;
    for (std::size_t i = 0; i < views_.size(); ++i) add_frame(i, classes);
    step();
    if (result_.summary.blobs == 0) fail_empty(classes);
    finish();
    return std::move(result_);
  }

 private:
  void step() {
    if (hooks_.progress) hooks_.progress(steps_done_, steps_);
    ++steps_done_;
  }

  Prepared prepare(std::size_t i) {
    const auto kept = kept_.find(i);
    if (kept != kept_.end()) return kept->second;
    const cv::Mat file = read_image(views_[i].path);
    if (file.cols != files_.width || file.rows != files_.height) {
      throw SegmentProblem{views_[i].path,
                           "is " + size_text(file.cols, file.rows) + " px, the calibration is for " +
                               size_text(files_.width, files_.height),
                           "give the calibration of these images; all must be of one size"};
    }
    Prepared prepared;
    prepared.image = straighten_(file);
    prepared.smooth = mean_shift(prepared.image, spatial_, options_.range);
    return prepared;
  }

  std::vector<ColourCluster> look_for_colours(std::size_t count) {
    constexpr std::size_t kMaxKept = std::size_t{256} << 20U;  // bytes
    std::vector<ColourCount> counts;
    std::size_t bytes = 0;
    for (std::size_t k = 0; k < count; ++k) {
      step();
      const std::size_t i = k * views_.size() / count;
      const Prepared prepared = prepare(i);
      const auto found = count_colours(prepared.smooth, options_.classes.background.darkest, i);
      counts.insert(counts.end(), found.begin(), found.end());
      bytes += 2 * prepared.smooth.total() * prepared.smooth.elemSize();
      if (bytes < kMaxKept) kept_.emplace(i, prepared);
    }
    return cluster_colours(std::move(counts), rules_.min_pixels / 2.0);
  }

  void add_frame(std::size_t i, ColourClasses& classes) {
    step();
    const Prepared prepared = prepare(i);
    kept_.erase(i);
    const cv::Mat labels = classes.labels_of(prepared.smooth);
    Regions regions = find_regions(labels, prepared.image, rules_);
    SegmentSummary& summary = result_.summary;
    summary.small += regions.small;
    summary.merged += regions.merged;
    if (regions.kept.size() > sensor::kMaxBlobs) {
      summary.dropped += regions.kept.size() - sensor::kMaxBlobs;
      regions.kept.resize(sensor::kMaxBlobs);
    }
    if (regions.kept.empty()) ++summary.empty;
    if (hooks_.labelled) {
      hooks_.labelled(i, labelled_image(prepared.image, labels, regions.kept, classes.signatures()));
    }
    sensor::BlobFrame frame;
    frame.t = base::Time::nearest(views_[i].pose.t) + files_.latency;
    frame.frame = static_cast<std::uint32_t>(i);
    std::set<std::uint8_t> seen;
    for (const ImageRegion& region : regions.kept) {
      sensor::Blob blob = to_blob(region);
      blob.signature = classes.signatures()[region.label - 1U].signature.signature;
      (void)frame.blobs.push_back(blob);
      if (seen.insert(region.label).second) ++summary.signatures[region.label - 1U].images;
    }
    summary.blobs += frame.blobs.size();
    frames_.push_back(frame);
  }

  [[noreturn]] void fail_empty(const ColourClasses& classes) const {
    throw SegmentProblem{views_.size() == 1 ? views_[0].path : "the images", "show nothing but background in any view",
                         !classes.background().empty() && options_.classes.signatures.empty()
                             ? "give the colours with --signatures or --colour, or the background's with --background"
                             : "check the colours that were given, or let them be found"};
  }

  void finish() {
    LogParts parts;
    parts.target = "segment";
    parts.camera = straighten_.camera();
    for (const SignatureUse& use : result_.summary.signatures) parts.signatures.push_back(use.signature);
    parts.odometry = odometry_of(views_);
    parts.frames = std::move(frames_);
    result_.summary.frames = parts.frames.size();
    result_.summary.width = parts.camera.width;
    result_.summary.height = parts.camera.height;
    result_.log = build_log(parts);
  }

  const std::vector<View>& views_;
  const sensor::CameraIntrinsics& files_;
  const SegmentOptions& options_;
  const SegmentHooks& hooks_;
  Straightener straighten_;
  double spatial_ = 0;
  RegionRules rules_;
  std::map<std::size_t, Prepared> kept_;  ///< of the first pass, for the second
  std::size_t steps_ = 0;
  std::size_t steps_done_ = 0;
  std::vector<sensor::BlobFrame> frames_;
  Segmented result_;
};

}  // namespace

SegmentResult segment(const std::vector<View>& views, const sensor::CameraIntrinsics& camera,
                      const SegmentOptions& options, const SegmentHooks& hooks) {
  try {
    if (views.empty()) throw SegmentProblem{"the images", "are none", "give a folder of PNG or JPEG files"};
    return Segmentation(views, camera, options, hooks).run();
  } catch (const SegmentProblem& problem) {
    return problem;
  }
}

}  // namespace fencepost::host
