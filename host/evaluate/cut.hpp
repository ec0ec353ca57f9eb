// The models of one object at one moment against its footprint.
#pragma once

#include "host/evaluate/evaluation.hpp"
#include "host/result/result.hpp"

namespace fencepost::host {

/// Position error and the score of every model; `end`: the moment is the end of the run.
Cut cut_of(const ObjectResult& object, const Polygon& footprint, bool end);

}  // namespace fencepost::host
