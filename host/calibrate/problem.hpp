// The least-squares problem of one log: who was seen where in the image, from where on the odometry's way.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "host/calibrate/odometry_track.hpp"
#include "host/calibrate/parameters.hpp"

namespace fencepost::host {

/// The camera's configured constants, which are not estimated: principal point, pixels' shape, image size.
struct ConfiguredOptics {
  double fx = 1;  ///< px
  double fy = 1;
  double cx = 0;
  double cy = 0;
  double width = 0;
  double height = 0;
  bool equidistant = false;
};

/// One object in one frame: continuous edges of its box, px. An end that is cut off or hidden is missing.
struct Sighting {
  std::size_t object = 0;  ///< index into Estimate::objects
  std::size_t node = 0;    ///< the last one before the exposure, by the configured latency
  double t = 0;            ///< s, when the frame arrived
  std::optional<double> left{};
  std::optional<double> right{};
  std::optional<double> foot{};
  std::optional<double> top{};
  double row_low = 0;  ///< the box's rows, whatever cuts them off
  double row_high = 0;
  double middle = 0;  ///< its middle column
};

/// Standard deviations of measurements in the image, px: a box's middle, its width, one edge alone, a row.
struct ImageNoise {
  double middle = 1;
  double width = 1;
  double edge = 1;
  double foot = 1;
  double top = 1;
};

/// The mean width (the diameter, if it is round) of an object is known, m.
struct KnownSize {
  std::size_t object = 0;
  double width = 0;
  double sigma = 0.001;  ///< m, of a ruler
};

/// Two objects' middles are so far apart, m.
struct KnownDistance {
  std::size_t a = 0;
  std::size_t b = 0;
  double distance = 0;
};

struct CalibrationProblem {
  ConfiguredOptics optics;
  bool rows = true;  ///< height and pitch are in play: feet and tops count
  OdometryTrack odometry;
  std::vector<double> node_times;
  std::vector<Sighting> sightings;
  std::vector<double> radii{};       ///< of the objects, at first: how far from round they may be
  std::vector<std::size_t> kinds{};  ///< of each object, index into Estimate::kinds
  std::vector<KnownSize> sizes{};
  std::vector<KnownDistance> distances{};
  CameraValues configured{};    ///< the prior's middle
  CameraValues camera_sigma{};  ///< how far off it may be
  WheelValues wheel_sigma{};
  ImageNoise noise{};
  double drift = 1;  ///< the odometry's random errors of turns over those of good wheels
  double walk = 1;   ///< and those of ways
};

}  // namespace fencepost::host
