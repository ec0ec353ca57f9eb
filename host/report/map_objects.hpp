// Footprints: the true ones and the models'.
#pragma once

#include <string>

#include "host/report/label_space.hpp"
#include "host/report/map_frame.hpp"

namespace fencepost::host {

std::string draw_truth(const MapFrame& frame, const Scene& truth);

/// All objects' outlines of one model, as one layer that can be switched off.
std::string draw_model(const MapFrame& frame, const ResultDocument& document, const std::string& model);

/// Number and name above each object, the true names below the footprints.
std::string draw_labels(const MapFrame& frame, const ResultDocument& document, const std::optional<Scene>& truth,
                        LabelSpace& space);

/// Where an object is drawn: its circle's centre, else the first outline's middle; nothing if it has neither.
std::optional<Point> object_position(const ObjectResult& object);

}  // namespace fencepost::host
