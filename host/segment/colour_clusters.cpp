#include "host/segment/colour_clusters.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <opencv2/imgproc.hpp>

namespace fencepost::host {

namespace {

constexpr double kRadius = kSameColour * kSameColour;  // squared, as all distances here

sensor::Rgb to_rgb(const cv::Vec3d& bgr) {
  const auto channel = [](double value) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
  };
  return {channel(bgr[2]), channel(bgr[1]), channel(bgr[0])};
}

struct Sample {
  Appearance looks;
  const ColourCount* count = nullptr;
};

/// Index of the nearest centre, and how far it is.
std::pair<std::size_t, double> nearest(const std::vector<Appearance>& centres, const Appearance& looks) {
  std::pair<std::size_t, double> best{0, std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const double distance = squared_distance(centres[i], looks);
    if (distance < best.second) best = {i, distance};
  }
  return best;
}

/// A centre wherever a point is farther than the radius from those before it; frequent colours come first.
std::vector<Appearance> first_centres(const std::vector<Sample>& points) {
  std::vector<Appearance> centres;
  for (const Sample& point : points) {
    if (nearest(centres, point.looks).second > kRadius) centres.push_back(point.looks);
  }
  return centres;
}

/// Each centre to the mean of its points, by their pixels; centres without any go.
std::vector<Appearance> moved_centres(const std::vector<Appearance>& centres, const std::vector<Sample>& points) {
  struct Sum {
    Appearance looks;
    double pixels = 0;
  };
  std::vector<Sum> sums(centres.size());
  for (const Sample& point : points) {
    Sum& sum = sums[nearest(centres, point.looks).first];
    const double pixels = point.count->pixels;
    sum.looks = {sum.looks.x + pixels * point.looks.x, sum.looks.y + pixels * point.looks.y,
                 sum.looks.z + pixels * point.looks.z};
    sum.pixels += pixels;
  }
  std::vector<Appearance> moved;
  for (const Sum& sum : sums) {
    if (sum.pixels == 0) continue;
    const Appearance centre{sum.looks.x / sum.pixels, sum.looks.y / sum.pixels, sum.looks.z / sum.pixels};
    if (nearest(moved, centre).second > kRadius / 4) moved.push_back(centre);
  }
  return moved;
}

std::vector<ColourCluster> described(const std::vector<Appearance>& centres, const std::vector<Sample>& points,
                                     double min_pixels) {
  std::vector<ColourCluster> clusters(centres.size());
  std::vector<cv::Vec3d> colours(centres.size(), cv::Vec3d(0, 0, 0));
  std::vector<std::map<std::size_t, double>> pixels_of(centres.size());
  for (const Sample& point : points) {
    const std::size_t i = nearest(centres, point.looks).first;
    clusters[i].pixels += point.count->pixels;
    clusters[i].border_pixels += point.count->border_pixels;
    colours[i] += point.count->pixels * point.count->bgr;
    pixels_of[i][point.count->image] += point.count->pixels;
  }
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    clusters[i].looks = centres[i];
    for (const auto& [image, pixels] : pixels_of[i]) clusters[i].images += pixels >= min_pixels ? 1 : 0;
    if (clusters[i].pixels > 0) clusters[i].rgb = to_rgb(colours[i] / clusters[i].pixels);
  }
  std::stable_sort(clusters.begin(), clusters.end(), [](const auto& a, const auto& b) { return a.pixels > b.pixels; });
  return clusters;
}

/// All neighbours of the pixel look like it.
bool is_inside(const cv::Mat& smooth, int u, int v) {
  constexpr int kStep = 6;  // grey levels; shading in a smoothed image is slower, edges are faster
  const cv::Vec3b& own = smooth.at<cv::Vec3b>(v, u);
  for (int row = std::max(0, v - 1); row <= std::min(smooth.rows - 1, v + 1); ++row) {
    for (int column = std::max(0, u - 1); column <= std::min(smooth.cols - 1, u + 1); ++column) {
      const cv::Vec3b& other = smooth.at<cv::Vec3b>(row, column);
      for (int c = 0; c < 3; ++c) {
        if (std::abs(own[c] - other[c]) > kStep) return false;
      }
    }
  }
  return true;
}

void add_pixel(ColourCount& count, const cv::Vec3b& colour, bool on_border) {
  count.bgr += cv::Vec3d(colour[0], colour[1], colour[2]);
  count.pixels += 1;
  if (on_border) count.border_pixels += 1;
}

}  // namespace

cv::Mat mean_shift(const cv::Mat& image, double spatial, double range) {
  cv::Mat smooth;
  constexpr int kPyramidLevels = 1;
  cv::pyrMeanShiftFiltering(image, smooth, spatial, range, kPyramidLevels);
  return smooth;
}

std::vector<ColourCount> count_colours(const cv::Mat& smooth, int darkest, std::size_t image) {
  const auto step = [](const cv::Vec3b& colour) { return std::array{colour[2] / 8, colour[1] / 8, colour[0] / 8}; };
  std::map<std::array<int, 3>, ColourCount> counts;
  for (int v = 0; v < smooth.rows; ++v) {
    for (int u = 0; u < smooth.cols; ++u) {
      const cv::Vec3b& colour = smooth.at<cv::Vec3b>(v, u);
      if (std::max({colour[0], colour[1], colour[2]}) < darkest || !is_inside(smooth, u, v)) continue;
      const bool on_border = u == 0 || v == 0 || u == smooth.cols - 1 || v == smooth.rows - 1;
      add_pixel(counts.try_emplace(step(colour), ColourCount{{0, 0, 0}, 0, 0, image}).first->second, colour, on_border);
    }
  }
  std::vector<ColourCount> list;
  for (auto& [key, count] : counts) {
    count.bgr /= count.pixels;
    list.push_back(count);
  }
  return list;
}

std::vector<ColourCluster> cluster_colours(std::vector<ColourCount> counts, double min_pixels) {
  constexpr int kRounds = 12;
  std::stable_sort(counts.begin(), counts.end(), [](const auto& a, const auto& b) { return a.pixels > b.pixels; });
  std::vector<Sample> points;
  points.reserve(counts.size());
  for (const ColourCount& count : counts) points.push_back({appearance(to_rgb(count.bgr)), &count});
  std::vector<Appearance> centres = first_centres(points);
  for (int round = 0; round < kRounds; ++round) centres = moved_centres(centres, points);
  return described(centres, points, min_pixels);
}

}  // namespace fencepost::host
