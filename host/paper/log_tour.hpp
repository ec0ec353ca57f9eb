// A recorded run as a tour: what `segment` made of images with known poses, or a simulated log.
#pragma once

#include <string_view>

#include "host/paper/tour.hpp"

namespace fencepost::host {

/// Frames and poses of the log's last run; `scene` has the truth, and the camera where the log has none. Odometry is
/// taken for the true pose. A blob's owner is the object that shows most pixels inside the blob's box. Objects with its
/// signature come first, for which a tenth of the box is enough, else a third. The blob's ends are occluded where they
/// are in the true image. Frames outside the odometry are left out. The path and the noise of `scene` play no part.
Tour tour_of_log(std::string_view log, const Scene& scene);

}  // namespace fencepost::host
