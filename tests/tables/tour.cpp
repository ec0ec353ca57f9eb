#include "tests/tables/tour.hpp"

#include <array>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "firmware/record/decode.hpp"
#include "firmware/record/encode.hpp"

namespace fencepost::test {
namespace {

/// Keeps the samples of a log by time.
struct Poses {
  std::map<base::Time, sensor::OdometrySample> samples;

  void accept(const sensor::OdometrySample& sample) { samples[sample.t] = sample; }
  template <class Other>
  void accept(const Other&) {}
};

std::string line_of(const sensor::BlobFrame& frame) {
  std::array<char, record::kMaxLine> line{};
  const std::size_t length = record::encode(frame, line);
  if (length == 0) throw std::runtime_error("a frame is outside the range of its record");
  return {line.data(), length};
}

}  // namespace

Tour drive_tour(host::Scene scene, const NoiseLevel& level) {
  Tour tour;
  tour.scene = std::move(scene);
  tour.scene.noise.pose_xy = level.pose_xy;
  tour.scene.noise.pose_heading = level.pose_heading * std::numbers::pi / 180;
  Poses poses;
  const auto keep_line = [&](std::string_view line) {
    if (line.starts_with("$FPFRM")) return;  // comes noisy, below
    tour.log += line;
    static_cast<void>(record::decode(line.substr(0, line.find_first_of("\r\n")), {}, poses));
  };
  std::vector<base::Time> exposures;
  const auto add_noise = [&](const host::FrameTruth& perfect) {
    tour.views.push_back({{}, noisy_view(tour.scene, perfect, level.blob)});
    tour.frames.push_back(frame_of(perfect, tour.views.back().blobs));
    tour.log += line_of(tour.frames.back().frame);
    exposures.push_back(perfect.exposure);
  };
  const auto summary = host::simulate_with_truth(tour.scene, keep_line, add_noise);
  if (!summary.ok()) throw std::runtime_error(summary.error());
  for (std::size_t i = 0; i < tour.views.size(); ++i) tour.views[i].pose = poses.samples.at(exposures[i]);
  return tour;
}

}  // namespace fencepost::test
