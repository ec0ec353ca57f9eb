#include "host/segment/colour_clusters.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <set>

#include "host/segment/connected.hpp"

namespace fencepost::host {

namespace {

constexpr double kRadius = kSameColour * kSameColour;  // squared, as all distances here

sensor::Rgb to_rgb(const cv::Vec3d& bgr) {
  const auto channel = [](double value) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
  };
  return {channel(bgr[2]), channel(bgr[1]), channel(bgr[0])};
}

struct Point {
  Appearance looks;
  const ColourRegion* region = nullptr;
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

/// A centre wherever a point is farther than the radius from those before it; large regions come first.
std::vector<Appearance> first_centres(const std::vector<Point>& points) {
  std::vector<Appearance> centres;
  for (const Point& point : points) {
    if (nearest(centres, point.looks).second > kRadius) centres.push_back(point.looks);
  }
  return centres;
}

/// Each centre to the mean of its points, by their pixels; centres without any go.
std::vector<Appearance> moved_centres(const std::vector<Appearance>& centres, const std::vector<Point>& points) {
  struct Sum {
    Appearance looks;
    double pixels = 0;
  };
  std::vector<Sum> sums(centres.size());
  for (const Point& point : points) {
    Sum& sum = sums[nearest(centres, point.looks).first];
    const double pixels = point.region->pixels;
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

std::vector<ColourCluster> described(const std::vector<Appearance>& centres, const std::vector<Point>& points) {
  std::vector<ColourCluster> clusters(centres.size());
  std::vector<cv::Vec3d> colours(centres.size(), cv::Vec3d(0, 0, 0));
  std::vector<std::set<std::size_t>> images(centres.size());
  for (const Point& point : points) {
    const std::size_t i = nearest(centres, point.looks).first;
    clusters[i].pixels += point.region->pixels;
    clusters[i].border_pixels += point.region->border_pixels;
    colours[i] += point.region->pixels * point.region->bgr;
    images[i].insert(point.region->image);
  }
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    clusters[i].looks = centres[i];
    clusters[i].images = images[i].size();
    if (clusters[i].pixels > 0) clusters[i].rgb = to_rgb(colours[i] / clusters[i].pixels);
  }
  std::stable_sort(clusters.begin(), clusters.end(), [](const auto& a, const auto& b) { return a.pixels > b.pixels; });
  return clusters;
}

std::vector<int> parts_of(const cv::Mat& smooth) {
  constexpr int kStep = 4;  // grey levels between neighbours of one region
  const auto pixel = [&](std::size_t at) -> const cv::Vec3b& {
    const auto columns = static_cast<std::size_t>(smooth.cols);
    return smooth.at<cv::Vec3b>(static_cast<int>(at / columns), static_cast<int>(at % columns));
  };
  const auto same = [&](std::size_t a, std::size_t b) {
    const cv::Vec3b& p = pixel(a);
    const cv::Vec3b& q = pixel(b);
    return std::abs(p[0] - q[0]) <= kStep && std::abs(p[1] - q[1]) <= kStep && std::abs(p[2] - q[2]) <= kStep;
  };
  return connected_parts(smooth.rows, smooth.cols, false, same);
}

/// All neighbours of the pixel are of its own part.
bool is_inside(const std::vector<int>& part, const cv::Size& size, int u, int v) {
  const auto part_of = [&](int column, int row) {
    return part[static_cast<std::size_t>(row) * static_cast<std::size_t>(size.width) +
                static_cast<std::size_t>(column)];
  };
  const int own = part_of(u, v);
  for (int row = std::max(0, v - 1); row <= std::min(size.height - 1, v + 1); ++row) {
    for (int column = std::max(0, u - 1); column <= std::min(size.width - 1, u + 1); ++column) {
      if (part_of(column, row) != own) return false;
    }
  }
  return true;
}

}  // namespace

cv::Mat mean_shift(const cv::Mat& image, double spatial, double range) {
  cv::Mat smooth;
  constexpr int kPyramidLevels = 1;
  cv::pyrMeanShiftFiltering(image, smooth, spatial, range, kPyramidLevels);
  return smooth;
}

std::vector<ColourRegion> colour_regions(const cv::Mat& smooth, double min_pixels, int darkest, std::size_t image) {
  const std::vector<int> part = parts_of(smooth);
  std::vector<ColourRegion> regions;
  for (int v = 0; v < smooth.rows; ++v) {
    for (int u = 0; u < smooth.cols; ++u) {
      const auto at = static_cast<std::size_t>(v) * static_cast<std::size_t>(smooth.cols) + static_cast<std::size_t>(u);
      const auto number = static_cast<std::size_t>(part[at]);
      if (number >= regions.size()) regions.resize(number + 1, {{0, 0, 0}, 0, 0, image});
      const cv::Vec3b& colour = smooth.at<cv::Vec3b>(v, u);
      if (std::max({colour[0], colour[1], colour[2]}) < darkest || !is_inside(part, smooth.size(), u, v)) continue;
      regions[number].bgr += cv::Vec3d(colour[0], colour[1], colour[2]);
      regions[number].pixels += 1;
      if (u == 0 || v == 0 || u == smooth.cols - 1 || v == smooth.rows - 1) regions[number].border_pixels += 1;
    }
  }
  std::erase_if(regions, [&](const ColourRegion& region) { return region.pixels < std::max(1.0, min_pixels); });
  for (ColourRegion& region : regions) region.bgr /= region.pixels;
  return regions;
}

std::vector<ColourCluster> cluster_colours(std::vector<ColourRegion> regions) {
  constexpr int kRounds = 12;
  std::stable_sort(regions.begin(), regions.end(), [](const auto& a, const auto& b) { return a.pixels > b.pixels; });
  std::vector<Point> points;
  points.reserve(regions.size());
  for (const ColourRegion& region : regions) points.push_back({appearance(to_rgb(region.bgr)), &region});
  std::vector<Appearance> centres = first_centres(points);
  for (int round = 0; round < kRounds; ++round) centres = moved_centres(centres, points);
  return described(centres, points);
}

}  // namespace fencepost::host
