#include "tests/studies/tables/noisy_views.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "host/simulate/random.hpp"

namespace fencepost::test {
namespace {

using host::BlobEnd;

/// A box by its edges: the image's left and top border are 0, pixel u covers [u, u + 1].
struct Extent {
  double left = 0;
  double right = 0;
  double top = 0;
  double bottom = 0;
};

struct Widest {
  Extent extent;
  bool left_hidden = false;
  bool right_hidden = false;
  std::uint8_t signature = 0;
};

bool hides(BlobEnd end, bool on_border) { return on_border || end == BlobEnd::kOccluded; }

std::optional<Widest> widest_piece(const host::FrameTruth& perfect, std::size_t object, int width) {
  std::optional<Widest> widest;
  double columns = 1;
  for (std::size_t b = 0; b < perfect.blobs.size(); ++b) {
    const sensor::Blob& blob = perfect.frame.blobs[b];
    const host::BlobTruth& truth = perfect.blobs[b];
    const double blob_columns = blob.x2 - blob.x1 + 1;
    if (truth.object != object || blob_columns <= columns) continue;
    columns = blob_columns;
    // A piece that the simulator calls cut by the border may end one pixel beside it: then the edge is true.
    widest = Widest{{double(blob.x1), blob.x2 + 1.0, double(blob.y1), blob.y2 + 1.0},
                    hides(truth.left, blob.x1 == 0),
                    hides(truth.right, blob.x2 == width - 1),
                    blob.signature};
  }
  return widest;
}

void lose_a_piece(host::Random& random, double width, bool happens, Extent& extent) {
  constexpr double kSplitShare = 0.3;
  const double lost = random.uniform(0.1, 0.5) * width;
  const bool splits = random.chance(kSplitShare);
  const double middle = random.uniform(0.2, 0.8) * width;
  const bool left = random.chance(0.5);
  if (!happens) return;
  if (!splits) {
    (left ? extent.left : extent.right) += left ? lost : -lost;
    return;
  }
  const double first = std::max(0.0, middle - lost / 2);
  const double second = std::max(0.0, width - middle - lost / 2);
  if (first >= second) {
    extent.right = extent.left + std::max(1.0, first);
  } else {
    extent.left = extent.right - std::max(1.0, second);
  }
}

void grow(host::Random& random, double width, bool happens, Extent& extent) {
  const double added = random.uniform(0.1, 0.6) * width;
  const bool left = random.chance(0.5);
  if (happens) (left ? extent.left : extent.right) += left ? -added : added;
}

double rounded(double edge) { return std::floor(edge + 0.5); }

void jitter(host::Random& random, double sigma, double rows, Extent& extent) {
  extent.left += sigma * random.gaussian();
  extent.right += sigma * random.gaussian();
  const double top = extent.top + sigma * random.gaussian();
  const double bottom = extent.bottom + sigma * random.gaussian();
  // Rows on the border stay: what goes on outside fills it whatever its edge does.
  if (extent.top > 0) extent.top = std::max(0.0, rounded(top));
  if (extent.bottom < rows) extent.bottom = std::min(rows, rounded(bottom));
}

Extent false_columns(host::Random& random, double image_width, Extent extent) {
  const double width = random.uniform(3, 40);
  extent.left = std::floor(random.uniform(0, image_width - width));
  extent.right = extent.left + std::floor(width);
  return extent;
}

sensor::Blob blob_of(const Extent& extent, std::uint8_t signature) {
  sensor::Blob blob;
  blob.signature = signature;
  blob.x1 = static_cast<std::int16_t>(extent.left);
  blob.x2 = static_cast<std::int16_t>(extent.right - 1);
  blob.y1 = static_cast<std::int16_t>(extent.top);
  blob.y2 = static_cast<std::int16_t>(std::max(extent.bottom - 1, extent.top));
  blob.cx = base::Pixels1::nearest((blob.x1 + blob.x2) / 2.0);
  blob.cy = base::Pixels1::nearest((blob.y1 + blob.y2) / 2.0);
  blob.pixels = static_cast<std::uint32_t>((blob.x2 - blob.x1 + 1) * (blob.y2 - blob.y1 + 1));
  return blob;
}

std::optional<GivenBlob> noisy_blob(host::Random random, const host::Scene& scene, const Widest& seen,
                                    const BlobNoise& noise, double nod) {
  const auto columns = static_cast<double>(scene.camera.width);
  const auto rows = static_cast<double>(scene.camera.height);
  const double width = seen.extent.right - seen.extent.left;
  Extent extent = seen.extent;
  jitter(random, noise.edge_px, rows, extent);
  const bool loses = random.chance(noise.loss);
  const bool grows = random.chance(noise.growth);
  const bool missed = random.chance(noise.miss);
  const bool is_false = random.chance(noise.false_blob);
  lose_a_piece(random, width, loses, extent);
  grow(random, width, grows, extent);
  extent.left = std::max(0.0, rounded(extent.left));
  extent.right = std::min(columns, rounded(extent.right));
  if (missed || extent.right - extent.left < 1) return std::nullopt;
  GivenBlob given;
  given.left_hidden = seen.left_hidden || extent.left <= 0;
  given.right_hidden = seen.right_hidden || extent.right >= columns;
  if (is_false) {
    extent = false_columns(random, columns, extent);
    given.left_hidden = given.right_hidden = false;
    given.is_false = true;
  }
  extent.bottom = std::min(rows, rounded(extent.bottom + nod));
  given.blob = blob_of(extent, seen.signature);
  return given;
}

}  // namespace

std::vector<GivenBlob> noisy_view(const host::Scene& scene, const host::FrameTruth& perfect, const BlobNoise& noise) {
  // The simulator's own noise is off: its streams of draws are free.
  host::Random pitch(scene.seed, host::Purpose::kLatency, perfect.frame.frame);
  const double nod = scene.camera.fy.to_double() * kPitchNoise * std::numbers::pi / 180 * pitch.gaussian();
  std::vector<GivenBlob> blobs;
  for (std::size_t object = 0; object < scene.objects.size(); ++object) {
    const auto seen = widest_piece(perfect, object, scene.camera.width);
    if (!seen) continue;
    const std::uint64_t stream = (std::uint64_t{perfect.frame.frame} << 16U) | object;
    auto given = noisy_blob(host::Random(scene.seed, host::Purpose::kDetection, stream), scene, *seen, noise, nod);
    if (!given) continue;
    given->object = object;
    blobs.push_back(*given);
  }
  return blobs;
}

host::FrameTruth frame_of(const host::FrameTruth& perfect, std::vector<GivenBlob> blobs) {
  std::stable_sort(blobs.begin(), blobs.end(),
                   [](const GivenBlob& a, const GivenBlob& b) { return a.blob.pixels > b.blob.pixels; });
  host::FrameTruth truth = perfect;
  truth.frame.blobs.clear();
  truth.blobs.clear();
  for (const GivenBlob& given : blobs) {
    if (!truth.frame.blobs.push_back(given.blob)) break;
    host::BlobTruth& told = truth.blobs.emplace_back();
    if (!given.is_false) told.object = given.object;
  }
  return truth;
}

}  // namespace fencepost::test
