#include "host/paper/figure_pictures.hpp"

#include "host/report/markup.hpp"

namespace fencepost::host {
namespace {

constexpr int kScale = 2;  ///< of images on the page
constexpr sensor::Rgb kBlack{20, 24, 30};

/// Enlarges by whole pixels, `scale` times in both directions, as drawn pictures are.
Picture enlarged(const Picture& picture, int scale) {
  Picture large{picture.width * scale, picture.height * scale, {}};
  large.rgb.reserve(picture.rgb.size() * static_cast<std::size_t>(scale * scale));
  for (int v = 0; v < large.height; ++v) {
    for (int u = 0; u < large.width; ++u) {
      const sensor::Rgb pixel = picture.at(u / scale, v / scale);
      large.rgb.insert(large.rgb.end(), {pixel.red, pixel.green, pixel.blue});
    }
  }
  return large;
}

}  // namespace

PictureView view_at(const Tour& tour, const TimedPose& robot) {
  const auto& pitch = tour.scene.camera.mount.pitch;
  return {tour.scene.camera, lens_at(tour.scene.camera, robot), pitch ? pitch->to_double() : 0.0, kScale};
}

std::vector<Solid> true_world(const Tour& tour) {
  std::vector<Solid> world;
  for (std::size_t i = 0; i < tour.scene.objects.size(); ++i) world.push_back(solid_of(tour.scene, i));
  return world;
}

Picture segmentation(const Tour& tour, std::size_t frame) {
  const PictureView view = view_at(tour, tour.frames[frame].pose);
  Picture picture = draw_picture(true_world(tour), view, PictureStyle::kSegmented);
  for (const Region& region : tour.images[frame].regions) draw_box(picture, view, region, kBlack);
  return picture;
}

Picture rendered_picture(const Tour& tour, const std::vector<Solid>& world, std::size_t frame,
                         const std::vector<Reacquisition>& both) {
  const PictureView view = view_at(tour, believed_pose(tour, frame));
  Picture picture = draw_picture(world, view, PictureStyle::kSegmented);
  for (const Region& region : tour.images[frame].regions) {
    if (region.signature == 1 || region.signature == 2) draw_box(picture, view, region, kBlack);
  }
  for (const Reacquisition& one : both) {
    if (one.rendered) draw_box(picture, view, *one.rendered, kTakenColour, true);
  }
  return picture;
}

std::string error_text(const Reacquisition& one) {
  return one.match ? markup::figure(one.match->error, 3) : std::string("not rendered");
}

Picture real_picture(const Tour& tour, std::size_t frame) {
  if (tour.photograph) return enlarged(tour.photograph(tour.frames[frame].frame.frame), kScale);
  return draw_picture(true_world(tour), view_at(tour, tour.frames[frame].pose), PictureStyle::kShaded);
}

std::string real_picture_name(const Tour& tour) { return tour.photograph ? "photograph" : "drawn from the scene"; }

}  // namespace fencepost::host
