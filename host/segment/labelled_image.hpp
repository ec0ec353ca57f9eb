// A picture of an image's blobs, for people.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "host/segment/colour_classes.hpp"
#include "host/segment/regions.hpp"

namespace fencepost::host {

/// The image in dim grey, found pixels in their signature's colour, a white box with the signature's number around each
/// region that became a blob.
cv::Mat labelled_image(const cv::Mat& image, const cv::Mat& labels, const std::vector<ImageRegion>& blobs,
                       const std::vector<SignatureUse>& signatures);

}  // namespace fencepost::host
