#include "host/paper/log_tour.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

#include "firmware/record/stream_reader.hpp"
#include "host/render/regions.hpp"
#include "host/simulate/optics.hpp"
#include "host/simulate/pieces.hpp"
#include "host/simulate/render.hpp"

namespace fencepost::host {
namespace {

/// Share of a blob's box that makes it an object's, where its signature says so too.
constexpr double kMinOfNamed = 0.1;
/// Share of a blob's box that makes it an object's, where nothing else does.
constexpr double kMinOfBox = 1.0 / 3;

/// The last run of a log.
struct LastRun {
  std::optional<sensor::CameraIntrinsics> camera;
  std::vector<sensor::OdometrySample> odometry;
  std::vector<sensor::BlobFrame> frames;

  void accept(const record::Header&) { *this = {}; }
  void accept(const sensor::CameraIntrinsics& seen) { camera = seen; }
  void accept(const sensor::OdometrySample& sample) { odometry.push_back(sample); }
  void accept(const sensor::BlobFrame& frame) { frames.push_back(frame); }
  template <class Other>
  void accept(const Other&) {}
};

LastRun read_run(std::string_view log) {
  LastRun run;
  std::array<char, record::StreamReader::kBuffer> buffer{};
  record::StreamReader reader(buffer);
  reader.push(log, run);
  reader.finish();
  return run;
}

std::optional<sensor::OdometrySample> pose_at(const std::vector<sensor::OdometrySample>& samples, base::Time t) {
  const auto after = std::find_if(samples.begin(), samples.end(), [&](const auto& sample) { return sample.t >= t; });
  if (after == samples.end()) return std::nullopt;
  if (after->t == t) return *after;
  if (after == samples.begin()) return std::nullopt;
  const sensor::OdometrySample& a = *(after - 1);
  const sensor::OdometrySample& b = *after;
  const double share = (t.to_double() - a.t.to_double()) / (b.t.to_double() - a.t.to_double());
  const double turn = std::remainder(b.heading.to_double() - a.heading.to_double(), 2 * std::numbers::pi);
  const auto between = [&](double from, double to) { return from + share * (to - from); };
  sensor::OdometrySample pose = a;
  pose.t = t;
  pose.x = base::Metres::nearest(between(a.x.to_double(), b.x.to_double()));
  pose.y = base::Metres::nearest(between(a.y.to_double(), b.y.to_double()));
  pose.heading = base::Radians::nearest(a.heading.to_double() + share * turn);
  return pose;
}

/// The true image at one pose, and the truth about blobs in it.
class TrueImage {
 public:
  explicit TrueImage(const Scene& scene)
      : scene_(scene),
        rays_(scene.camera, scene.camera.mount.pitch ? scene.camera.mount.pitch->to_double() : 0.0),
        image_(scene.camera.width, scene.camera.height) {}

  void look(const TimedPose& robot) {
    image_.render(scene_.objects, rays_, lens_at(scene_.camera, robot));
    widest_.assign(scene_.objects.size(), PixelBox{});
    std::vector<std::uint8_t> each(scene_.objects.size());
    std::iota(each.begin(), each.end(), std::uint8_t{0});
    for (const Piece& piece : find_pieces(image_, each)) {
      PixelBox& widest = widest_[piece.object];
      if (widest.empty() || piece.box.x2 - piece.box.x1 > widest.x2 - widest.x1) widest = piece.box;
    }
  }

  [[nodiscard]] BlobTruth truth_of(const sensor::Blob& blob) const {
    BlobTruth truth;
    truth.object = owner_of(blob);
    if (truth.object) {
      const HiddenEnds ends = hidden(*truth.object);
      if (ends.left) truth.left = BlobEnd::kOccluded;
      if (ends.right) truth.right = BlobEnd::kOccluded;
    }
    if (blob.x1 <= 1) truth.left = BlobEnd::kBorder;
    if (blob.x2 >= image_.width() - 2) truth.right = BlobEnd::kBorder;
    return truth;
  }

  [[nodiscard]] HiddenEnds hidden(std::size_t object) const {
    const PixelBox& seen = widest_[object];
    const PixelBox& alone = image_.alone(object);
    if (seen.empty()) return {};
    return {seen.x1 <= 1 || seen.x1 > alone.x1, seen.x2 >= image_.width() - 2 || seen.x2 < alone.x2};
  }

 private:
  [[nodiscard]] std::optional<std::size_t> owner_of(const sensor::Blob& blob) const {
    std::vector<int> pixels(scene_.objects.size(), 0);
    for (int v = std::max<int>(0, blob.y1); v <= std::min<int>(blob.y2, image_.height() - 1); ++v) {
      for (int u = std::max<int>(0, blob.x1); u <= std::min<int>(blob.x2, image_.width() - 1); ++u) {
        if (image_.at(u, v) != LabelImage::kNothing) ++pixels[static_cast<std::size_t>(image_.at(u, v))];
      }
    }
    const bool named = std::any_of(scene_.objects.begin(), scene_.objects.end(),
                                   [&](const SceneObject& object) { return object.signature == blob.signature; });
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      if (named && scene_.objects[i].signature != blob.signature) continue;
      if (pixels[i] > 0 && (!best || pixels[i] > pixels[*best])) best = i;
    }
    const double box = (blob.x2 - blob.x1 + 1.0) * (blob.y2 - blob.y1 + 1.0);
    if (best && pixels[*best] < (named ? kMinOfNamed : kMinOfBox) * box) best.reset();
    return best;
  }

  const Scene& scene_;
  PixelRays rays_;
  LabelImage image_;
  std::vector<PixelBox> widest_;  ///< of each object's pieces
};

}  // namespace

Tour tour_of_log(std::string_view log, const Scene& scene) {
  const LastRun run = read_run(log);
  Tour tour;
  tour.scene = scene;
  tour.scene.path = std::monostate{};
  if (run.camera) tour.scene.camera = *run.camera;
  tour.log = log;
  TrueImage image(tour.scene);
  for (const sensor::BlobFrame& frame : run.frames) {
    const base::Time exposure = frame.t - tour.scene.camera.latency;
    const auto pose = pose_at(run.odometry, exposure);
    if (!pose) continue;
    tour.poses.push_back(*pose);
    FrameTruth& truth = tour.frames.emplace_back();
    truth.frame = frame;
    truth.exposure = exposure;
    truth.pose = believed_pose(tour, tour.frames.size() - 1);
    image.look(truth.pose);
    RealImage& real = tour.images.emplace_back();
    for (const sensor::Blob& blob : frame.blobs) {
      truth.blobs.push_back(image.truth_of(blob));
      real.regions.push_back(region_of(blob));
    }
    real.truths = truth.blobs;
    std::vector<HiddenEnds>& ends = tour.hidden.emplace_back();
    for (std::size_t object = 0; object < scene.objects.size(); ++object) ends.push_back(image.hidden(object));
  }
  return tour;
}

}  // namespace fencepost::host
