#include "host/paper/tour.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>

#include "firmware/record/decode.hpp"
#include "host/paper/blocks_world.hpp"
#include "host/simulate/random.hpp"

namespace fencepost::host {
namespace {

/// Keeps the odometry of a log by time.
struct Poses {
  std::map<base::Time, sensor::OdometrySample> samples;
  void accept(const sensor::OdometrySample& sample) { samples[sample.t] = sample; }
  template <class Other>
  void accept(const Other&) {}
};

bool is_cut(BlobEnd end) { return end == BlobEnd::kBorder || end == BlobEnd::kOccluded; }

/// Colours are off by kColourNoise; draws depend on the scene's seed and the frame only.
RealImage image_of(const FrameTruth& truth, std::uint64_t seed) {
  RealImage image;
  image.truths = truth.blobs;
  Random random(seed ^ 0x636f6c6f7572ULL, Purpose::kDetection, truth.frame.frame);
  for (const sensor::Blob& blob : truth.frame.blobs) {
    Region region = region_of(blob);
    if (region.colour) {
      for (double* channel : {&region.colour->red, &region.colour->green, &region.colour->blue}) {
        *channel = std::clamp(*channel + kColourNoise * random.gaussian(), 0.0, 255.0);
      }
    }
    image.regions.push_back(region);
  }
  return image;
}

/// Hidden ends in each frame of the scene without noise.
std::vector<std::vector<HiddenEnds>> hidden_ends(Scene scene) {
  scene.noise = {};
  std::vector<std::vector<HiddenEnds>> frames;
  const auto look = [&](const FrameTruth& truth) {
    std::vector<HiddenEnds>& ends = frames.emplace_back(scene.objects.size());
    std::vector<int> widest(scene.objects.size(), 0);
    for (std::size_t b = 0; b < truth.blobs.size(); ++b) {
      const sensor::Blob& blob = truth.frame.blobs[b];
      const std::size_t object = truth.blobs[b].object.value();
      const int width = blob.x2 - blob.x1 + 1;
      if (width <= widest[object]) continue;
      widest[object] = width;
      ends[object] = {is_cut(truth.blobs[b].left), is_cut(truth.blobs[b].right)};
    }
  };
  const auto summary = simulate_with_truth(
      scene, [](std::string_view) {}, look);
  if (!summary.ok()) throw std::runtime_error(summary.error());
  return frames;
}

}  // namespace

Tour drive(const Scene& scene) {
  Tour tour;
  tour.scene = scene;
  Poses poses;
  const auto keep_line = [&](std::string_view line) {
    tour.log += line;
    static_cast<void>(record::decode(line.substr(0, line.find_first_of("\r\n")), {}, poses));
  };
  const auto keep_truth = [&](const FrameTruth& truth) {
    tour.frames.push_back(truth);
    tour.images.push_back(image_of(truth, scene.seed));
  };
  const auto summary = simulate_with_truth(scene, keep_line, keep_truth);
  if (!summary.ok()) throw std::runtime_error(summary.error());
  for (const FrameTruth& frame : tour.frames) {
    const auto sample = poses.samples.find(frame.exposure);
    if (sample == poses.samples.end()) throw std::runtime_error("a frame was exposed between two odometry samples");
    tour.poses.push_back(sample->second);
  }
  tour.hidden = hidden_ends(scene);
  return tour;
}

TimedPose believed_pose(const Tour& tour, std::size_t frame) {
  const sensor::OdometrySample& pose = tour.poses[frame];
  return {pose.t.to_double(), pose.x.to_double(), pose.y.to_double(), pose.heading.to_double()};
}

bool is_of(const BlobTruth& region, std::size_t object) {
  return region.object == object ||
         std::find(region.others.begin(), region.others.end(), object) != region.others.end();
}

bool is_whole_in(const RealImage& image, std::size_t object) {
  for (std::size_t i = 0; i < image.truths.size(); ++i) {
    const BlobTruth& truth = image.truths[i];
    if (truth.object == object && truth.others.empty() && !is_cut(truth.left) && !is_cut(truth.right) &&
        image.regions[i].width() >= kMinWhole) {
      return true;
    }
  }
  return false;
}

}  // namespace fencepost::host
