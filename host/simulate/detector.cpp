#include "host/simulate/detector.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "host/simulate/random.hpp"

namespace fencepost::host {

namespace {

/// A box by its continuous edges: pixel u covers [u - 0.5, u + 0.5].
struct Extent {
  double left = 0;
  double top = 0;
  double right = 0;
  double bottom = 0;
  [[nodiscard]] double width() const { return right - left; }
};

/// One piece on its way through the noise.
struct Candidate {
  Extent extent;
  BlobEnd left = BlobEnd::kEdge;
  BlobEnd right = BlobEnd::kEdge;
};

/// All random numbers that one piece may need, drawn whether or not a noise is enabled.
struct Draws {
  explicit Draws(Random& random)
      : jitter{random.gaussian(), random.gaussian(), random.gaussian(), random.gaussian()},
        loss(random.uniform()),
        loss_share(random.uniform()),
        split(random.uniform()),
        split_place(random.uniform()),
        loss_left(random.chance(0.5)),
        growth(random.uniform()),
        growth_share(random.uniform()),
        growth_left(random.chance(0.5)),
        miss(random.uniform()),
        swap(random.uniform()),
        swap_pick(random.uniform()) {}
  double jitter[4];
  double loss;
  double loss_share;
  double split;
  double split_place;
  bool loss_left;
  double growth;
  double growth_share;
  bool growth_left;
  double miss;
  double swap;
  double swap_pick;
};

/// An end on the image's first or last line stays there: the object goes on outside, whatever its edge does.
Extent moved_edges(const PixelBox& box, std::uint8_t signature, const LabelImage& image, const SceneNoise& noise,
                   const Draws& draws) {
  Extent extent{box.x1 - 0.5, box.y1 - 0.5, box.x2 + 0.5, box.y2 + 0.5};
  const auto own = noise.edge_bias_of.find(signature);
  const double out = own == noise.edge_bias_of.end() ? noise.edge_bias_px : own->second;
  if (box.x1 > 0) extent.left += noise.edge_px * draws.jitter[0] - out;
  if (box.x2 < image.width() - 1) extent.right += noise.edge_px * draws.jitter[1] + out;
  if (box.y1 > 0) extent.top += noise.edge_px * draws.jitter[2] - out;
  if (box.y2 < image.height() - 1) extent.bottom += noise.edge_px * draws.jitter[3] + out;
  return extent;
}

void grow(Candidate& candidate, const SceneNoise& noise, double width, const Draws& draws) {
  if (!(draws.growth < noise.growth_probability)) return;
  const double added = draws.growth_share * noise.growth_max * width;
  if (draws.growth_left) {
    candidate.extent.left -= added;
    candidate.left = BlobEnd::kGrown;
  } else {
    candidate.extent.right += added;
    candidate.right = BlobEnd::kGrown;
  }
}

/// Takes a piece away, from one side or out of the middle; then there are two.
std::vector<Candidate> damaged(const Candidate& whole, const SceneNoise& noise, double width, const Draws& draws) {
  if (!(draws.loss < noise.loss_probability)) return {whole};
  const double lost = (noise.loss_min + (noise.loss_max - noise.loss_min) * draws.loss_share) * width;
  Candidate first = whole;
  if (draws.split < noise.split_share) {
    constexpr double kInnermost = 0.2;  // the gap's middle lies in the central 60 % of the width
    const double middle = whole.extent.left + (kInnermost + (1 - 2 * kInnermost) * draws.split_place) * width;
    Candidate second = whole;
    first.extent.right = middle - lost / 2;
    first.right = BlobEnd::kLost;
    second.extent.left = middle + lost / 2;
    second.left = BlobEnd::kLost;
    return {first, second};
  }
  if (draws.loss_left) {
    first.extent.left += lost;
    first.left = BlobEnd::kLost;
  } else {
    first.extent.right -= lost;
    first.right = BlobEnd::kLost;
  }
  return {first};
}

/// Whole pixels inside the image; nothing when less than one is left.
std::optional<PixelBox> to_pixels(const Extent& extent, const LabelImage& image) {
  PixelBox box;
  box.x1 = static_cast<int>(std::floor(std::max(extent.left, -0.5) + 1));
  box.x2 = static_cast<int>(std::ceil(std::min(extent.right, image.width() - 0.5) - 1));
  box.y1 = static_cast<int>(std::floor(std::max(extent.top, -0.5) + 1));
  box.y2 = static_cast<int>(std::ceil(std::min(extent.bottom, image.height() - 0.5) - 1));
  if (box.x1 > box.x2 || box.y1 > box.y2) return std::nullopt;
  return box;
}

double box_area(const PixelBox& box) {
  return static_cast<double>(box.x2 - box.x1 + 1) * static_cast<double>(box.y2 - box.y1 + 1);
}

/// The coordinate at the same share of the new interval as `at` had of the old one (continuous edges).
double carried_over(double at, int old1, int old2, int new1, int new2) {
  const double share = (at - old1 + 0.5) / (old2 - old1 + 1);
  return new1 - 0.5 + share * (new2 - new1 + 1);
}

/// Pixel count in proportion to the box, centroid at the same relative place; exact where the box is untouched.
sensor::Blob to_blob(const Piece& piece, const PixelBox& box) {
  sensor::Blob blob;
  blob.x1 = static_cast<std::int16_t>(box.x1);
  blob.y1 = static_cast<std::int16_t>(box.y1);
  blob.x2 = static_cast<std::int16_t>(box.x2);
  blob.y2 = static_cast<std::int16_t>(box.y2);
  const auto count = static_cast<double>(piece.pixels);
  const double u = static_cast<double>(piece.sum_u) / count;
  const double v = static_cast<double>(piece.sum_v) / count;
  const double scaled = std::round(count * box_area(box) / box_area(piece.box));
  blob.pixels = static_cast<std::uint32_t>(std::max(1.0, scaled));
  const bool same_columns = box.x1 == piece.box.x1 && box.x2 == piece.box.x2;
  const bool same_rows = box.y1 == piece.box.y1 && box.y2 == piece.box.y2;
  blob.cx = base::Pixels1::nearest(same_columns ? u : carried_over(u, piece.box.x1, piece.box.x2, box.x1, box.x2));
  blob.cy = base::Pixels1::nearest(same_rows ? v : carried_over(v, piece.box.y1, piece.box.y2, box.y1, box.y2));
  return blob;
}

Candidate as_seen(const Piece& piece, const LabelImage& image) {
  Candidate candidate;
  if (piece.box.x1 > image.alone(piece.left).x1) candidate.left = BlobEnd::kOccluded;
  if (piece.box.x2 < image.alone(piece.right).x2) candidate.right = BlobEnd::kOccluded;
  return candidate;
}

/// The border rule of the stream format; it takes precedence over every other reason.
void mark_border(Detection& detection, int width) {
  if (detection.blob.x1 <= 1) detection.truth.left = BlobEnd::kBorder;
  if (detection.blob.x2 >= width - 2) detection.truth.right = BlobEnd::kBorder;
}

sensor::Rgb colour_of(const Scene& scene, std::uint8_t signature) {
  for (const SceneSignature& known : scene.signatures) {
    if (known.id == signature) return known.rgb;
  }
  return {};
}

/// Another signature of the scene, or the same where there is no other.
std::uint8_t swapped(const Scene& scene, std::uint8_t signature, const Draws& draws) {
  if (!(draws.swap < scene.noise.signature_swap_probability) || scene.signatures.size() < 2) return signature;
  std::vector<std::uint8_t> others;
  for (const SceneSignature& known : scene.signatures) {
    if (known.id != signature) others.push_back(known.id);
  }
  return others[static_cast<std::size_t>(draws.swap_pick * static_cast<double>(others.size()))];
}

void detect_piece(const Scene& scene, const LabelImage& image, const Piece& piece, Random random,
                  std::vector<Detection>& found) {
  const Draws draws(random);
  if (draws.miss < scene.noise.miss_probability) return;
  Candidate whole = as_seen(piece, image);
  const std::uint8_t signature = scene.objects[piece.object].signature;
  whole.extent = moved_edges(piece.box, signature, image, scene.noise, draws);
  const double width = whole.extent.width();
  if (width <= 0) return;
  grow(whole, scene.noise, width, draws);
  for (const Candidate& candidate : damaged(whole, scene.noise, width, draws)) {
    const auto box = to_pixels(candidate.extent, image);
    if (!box) continue;
    Detection detection{to_blob(piece, *box),
                        {piece.object, piece.others, candidate.left, candidate.right, piece.nearest}};
    detection.blob.signature = swapped(scene, signature, draws);
    detection.blob.rgb = colour_of(scene, signature);
    mark_border(detection, image.width());
    found.push_back(detection);
  }
}

void add_false_blobs(const Scene& scene, const LabelImage& image, std::uint64_t frame, std::vector<Detection>& found) {
  if (scene.noise.false_rate <= 0 || scene.signatures.empty()) return;
  constexpr int kSmallest = 3;  // px a side
  constexpr int kLargest = 40;
  Random random(scene.seed, Purpose::kFalseBlobs, frame);
  const auto side = [&](int image_side) {
    const int limit = std::min(kLargest, image_side);
    const int least = std::min(kSmallest, limit);
    return least + static_cast<int>(random.below(static_cast<std::uint64_t>(limit - least + 1)));
  };
  const auto place = [&](int image_side, int size) {
    return static_cast<int>(random.below(static_cast<std::uint64_t>(image_side - size + 1)));
  };
  for (unsigned count = random.poisson(scene.noise.false_rate); count > 0; --count) {
    const int width = side(image.width());
    const int height = side(image.height());
    Piece piece;
    piece.box.x1 = place(image.width(), width);
    piece.box.y1 = place(image.height(), height);
    piece.box.x2 = piece.box.x1 + width - 1;
    piece.box.y2 = piece.box.y1 + height - 1;
    piece.pixels = std::int64_t{width} * height;
    piece.sum_u = piece.pixels * (piece.box.x1 + piece.box.x2) / 2;
    piece.sum_v = piece.pixels * (piece.box.y1 + piece.box.y2) / 2;
    Detection detection{to_blob(piece, piece.box), {}};
    const SceneSignature& signature = scene.signatures[static_cast<std::size_t>(random.below(scene.signatures.size()))];
    detection.blob.signature = signature.id;
    detection.blob.rgb = signature.rgb;
    mark_border(detection, image.width());
    found.push_back(detection);
  }
}

}  // namespace

std::vector<Detection> detect(const Scene& scene, const LabelImage& image, std::uint64_t frame) {
  std::vector<Detection> found;
  std::vector<std::uint8_t> signatures;
  for (const SceneObject& object : scene.objects) signatures.push_back(object.signature);
  std::size_t ordinal = 0;  // of the piece within its object
  std::optional<std::size_t> object;
  for (const Piece& piece : find_pieces(image, signatures)) {
    ordinal = piece.object == object ? ordinal + 1 : 0;
    object = piece.object;
    // Room for 2^12 pieces of 2^16 objects in 2^36 frames.
    const std::uint64_t stream = (frame << 28U) | (std::uint64_t{piece.object} << 12U) | std::uint64_t{ordinal};
    detect_piece(scene, image, piece, Random(scene.seed, Purpose::kDetection, stream), found);
  }
  add_false_blobs(scene, image, frame, found);
  std::stable_sort(found.begin(), found.end(), [](const Detection& a, const Detection& b) {
    return std::tuple(b.blob.pixels, a.blob.x1, a.blob.y1) < std::tuple(a.blob.pixels, b.blob.x1, b.blob.y1);
  });
  return found;
}

}  // namespace fencepost::host
