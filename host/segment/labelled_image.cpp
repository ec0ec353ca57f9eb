#include "host/segment/labelled_image.hpp"

#include <opencv2/imgproc.hpp>
#include <string>

namespace fencepost::host {

cv::Mat labelled_image(const cv::Mat& image, const cv::Mat& labels, const std::vector<ImageRegion>& blobs,
                       const std::vector<SignatureUse>& signatures) {
  constexpr double kDim = 0.5;
  cv::Mat grey;
  cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  cv::Mat picture;
  cv::cvtColor(grey * kDim, picture, cv::COLOR_GRAY2BGR);
  for (int v = 0; v < labels.rows; ++v) {
    for (int u = 0; u < labels.cols; ++u) {
      const std::uint8_t label = labels.at<std::uint8_t>(v, u);
      if (label == 0) continue;
      const sensor::Rgb rgb = signatures[label - 1U].signature.rgb;
      picture.at<cv::Vec3b>(v, u) = cv::Vec3b(rgb.blue, rgb.green, rgb.red);
    }
  }
  const cv::Scalar white(255, 255, 255);
  for (const ImageRegion& blob : blobs) {
    cv::rectangle(picture, {blob.x1, blob.y1}, {blob.x2, blob.y2}, white);
    const int number = signatures[blob.label - 1U].signature.signature;
    constexpr double kLetter = 0.4;  // of the font's own size, about 9 px high
    cv::putText(picture, std::to_string(number), {blob.x1 + 2, blob.y1 + 11}, cv::FONT_HERSHEY_SIMPLEX, kLetter, white);
  }
  return picture;
}

}  // namespace fencepost::host
