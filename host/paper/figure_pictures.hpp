// Images of a tour: as the camera took them, as it segments them, as models render them.
#pragma once

#include <string>
#include <vector>

#include "host/paper/reacquire.hpp"
#include "host/paper/tour.hpp"
#include "host/render/picture.hpp"

namespace fencepost::host {

inline constexpr sensor::Rgb kTakenColour{200, 0, 160};

/// The view that the pictures below are drawn onto.
PictureView view_at(const Tour& tour, const TimedPose& robot);

std::vector<Solid> true_world(const Tour& tour);

/// The photograph of `frame` where the tour has any, else the true world from the true pose, as a camera would take it.
Picture real_picture(const Tour& tour, std::size_t frame);
/// The kind of real_picture(): "photograph", or "drawn from the scene".
std::string real_picture_name(const Tour& tour);

/// The silhouettes in flat colours, and around them the boxes that the camera reports.
Picture segmentation(const Tour& tour, std::size_t frame);

/// The models' silhouettes from the believed pose; their boxes dashed, the real regions' boxes solid.
Picture rendered_picture(const Tour& tour, const std::vector<Solid>& world, std::size_t frame,
                         const std::vector<Reacquisition>& both);

/// "0.123", or "not rendered".
std::string error_text(const Reacquisition& one);

}  // namespace fencepost::host
