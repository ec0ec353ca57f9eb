#include "host/render/regions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "host/simulate/pieces.hpp"

namespace fencepost::host {
namespace {

/// Numbers of solids go where the simulator has signatures.
constexpr std::size_t kMaxSolids = 256;

double known_pitch(const sensor::CameraIntrinsics& camera) {
  return camera.mount.pitch ? camera.mount.pitch->to_double() : 0.0;
}

/// One polygon of a solid as the simulator's renderer takes it; the label is its place in the list.
struct Parts {
  std::vector<SceneObject> objects;
  std::vector<std::size_t> solid;  ///< of each object
};

Parts parts_of(std::span<const Solid> solids, const CameraPose& lens) {
  Parts parts;
  for (std::size_t i = 0; i < solids.size(); ++i) {
    const Solid& solid = solids[i];
    if (!(solid.z_max > solid.z_min) || encloses(solid, lens.x, lens.y, lens.z)) continue;
    for (const Polygon& polygon : solid.footprint) {
      if (polygon.outer.size() < 3) continue;
      parts.objects.push_back({"", 0, solid.z_min, solid.z_max - solid.z_min, polygon});
      parts.solid.push_back(i);
    }
  }
  return parts;
}

/// Columns that the solid would have in an image without borders; infinite if it reaches behind the lens.
double whole_width(const Solid& solid, const CameraPose& lens, double fx) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const Polygon& polygon : solid.footprint) {
    const Prism prism({"", 0, solid.z_min, solid.z_max - solid.z_min, polygon}, lens);
    if (prism.behind()) continue;
    low = std::min(low, prism.across_min());
    high = std::max(high, prism.across_max());
  }
  return fx * (high - low);
}

Region region_of_piece(const Piece& piece, const Solid& solid) {
  return {piece.box.x1 - 0.5,
          piece.box.y1 - 0.5,
          piece.box.x2 + 0.5,
          piece.box.y2 + 0.5,
          static_cast<double>(piece.pixels),
          solid.signature,
          colour_of(solid.colour)};
}

}  // namespace

RegionRenderer::RegionRenderer(const sensor::CameraIntrinsics& camera)
    : camera_(camera), rays_(camera, known_pitch(camera)), image_(camera.width, camera.height) {}

std::vector<std::optional<Region>> RegionRenderer::render(std::span<const Solid> solids, const CameraPose& lens) {
  if (solids.size() > kMaxSolids) throw std::length_error("more solids than one image can tell apart");
  const Parts parts = parts_of(solids, lens);
  image_.render(parts.objects, rays_, lens);
  // Parts of one solid are one region where they touch; those of two are not.
  std::vector<std::uint8_t> signatures;
  for (const std::size_t solid : parts.solid) signatures.push_back(static_cast<std::uint8_t>(solid));
  std::vector<std::optional<Region>> regions(solids.size());
  for (const Piece& piece : find_pieces(image_, signatures)) {
    const std::size_t solid = parts.solid[piece.object];
    std::optional<Region>& best = regions[solid];
    if (best && best->pixels >= static_cast<double>(piece.pixels)) continue;
    best = region_of_piece(piece, solids[solid]);
  }
  for (std::size_t i = 0; i < solids.size(); ++i) {
    if (!regions[i]) continue;
    const double columns = regions[i]->right - regions[i]->left;
    const double whole = whole_width(solids[i], lens, camera_.fx.to_double());
    if (columns < kMinRenderedColumns || columns < kMinRenderedShare * whole) regions[i].reset();
  }
  return regions;
}

CameraPose lens_at(const sensor::CameraIntrinsics& camera, const TimedPose& robot) {
  const double c = std::cos(robot.heading);
  const double s = std::sin(robot.heading);
  const double x = camera.mount.x.to_double();
  const double y = camera.mount.y.to_double();
  return {robot.x + c * x - s * y, robot.y + s * x + c * y, camera.mount.z.to_double(),
          robot.heading + camera.mount.yaw.to_double()};
}

}  // namespace fencepost::host
