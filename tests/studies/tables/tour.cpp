#include "tests/studies/tables/tour.hpp"

#include <map>
#include <numbers>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "firmware/record/decode.hpp"
#include "tests/firmware/record/lines.hpp"

namespace fencepost::test {
namespace {

/// Keeps the samples of a log by time.
struct Poses {
  std::map<base::Time, sensor::OdometrySample> samples;

  void accept(const sensor::OdometrySample& sample) { samples[sample.t] = sample; }
  template <class Other>
  void accept(const Other&) {}
};

std::string_view content_of(std::string_view line) { return line.substr(0, line.find_first_of("\r\n")); }

Tour drive(host::Scene scene, const BlobNoise& noise, const OdometryNoise& odometry) {
  Tour tour;
  tour.scene = std::move(scene);
  Poses poses;
  const auto keep_line = [&](std::string_view line) {
    if (line.starts_with("$FPFRM")) return;  // comes noisy, below
    std::string kept(line);
    if (odometry && line.starts_with("$FPODO")) {
      Poses one;
      static_cast<void>(record::decode(content_of(line), {}, one));
      kept = line_of(odometry(one.samples.begin()->second));
    }
    tour.log += kept;
    static_cast<void>(record::decode(content_of(kept), {}, poses));
  };
  std::vector<base::Time> exposures;
  const auto add_noise = [&](const host::FrameTruth& perfect) {
    tour.views.push_back({{}, noisy_view(tour.scene, perfect, noise)});
    tour.frames.push_back(frame_of(perfect, tour.views.back().blobs));
    tour.log += line_of(tour.frames.back().frame);
    exposures.push_back(perfect.exposure);
  };
  const auto summary = host::simulate_with_truth(tour.scene, keep_line, add_noise);
  if (!summary.ok()) throw std::runtime_error(summary.error());
  for (std::size_t i = 0; i < tour.views.size(); ++i) tour.views[i].pose = poses.samples.at(exposures[i]);
  return tour;
}

}  // namespace

Tour drive_tour(host::Scene scene, const NoiseLevel& level) {
  scene.noise.pose_xy = level.pose_xy;
  scene.noise.pose_heading = level.pose_heading * std::numbers::pi / 180;
  return drive(std::move(scene), level.blob, {});
}

Tour drive_tour(host::Scene scene, const BlobNoise& noise, const OdometryNoise& odometry) {
  return drive(std::move(scene), noise, odometry);
}

}  // namespace fencepost::test
