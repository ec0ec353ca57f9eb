// Pictures a second of the segmenter on one core, beside OpenCV doing the same: `toolchain/bench`.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <memory>
#include <opencv2/imgproc.hpp>
#include <random>
#include <vector>

#include "drivers/segmenter/camera.hpp"

namespace fencepost::bench {
namespace {

constexpr int kColumns = 320;
constexpr int kRows = 240;

/// Four orange blocks on a grey that is not quite even; RGB.
std::vector<std::uint8_t> blocks() {
  std::mt19937 random(1);
  std::vector<std::uint8_t> bytes;
  for (int v = 0; v < kRows; ++v) {
    for (int u = 0; u < kColumns; ++u) {
      const bool block = u % 80 > 30 && u % 80 < 60 && v > 90 && v < 160;
      for (const int level : {block ? 230 : 120, block ? 110 : 120, block ? 30 : 120}) {
        bytes.push_back(static_cast<std::uint8_t>(level + static_cast<int>(random() % 9) - 4));
      }
    }
  }
  return bytes;
}

/// The same as a webcam sends it, of such pictures full range.
std::vector<std::uint8_t> yuyv_of(const std::vector<std::uint8_t>& rgb) {
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i < rgb.size(); i += 6) {
    const double red = rgb[i];
    const double green = rgb[i + 1];
    const double blue = rgb[i + 2];
    const double y = 0.299 * red + 0.587 * green + 0.114 * blue;
    const auto level = [](double value) { return static_cast<std::uint8_t>(std::clamp(value, 0.0, 255.0)); };
    bytes.insert(bytes.end(), {level(y), level(128 + (blue - y) / 1.772), level(y), level(128 + (red - y) / 1.402)});
  }
  return bytes;
}

void run_segmenter(benchmark::State& state, bus::PixelLayout layout) {
  const std::vector<std::uint8_t> rgb = blocks();
  const std::vector<std::uint8_t> bytes = layout == bus::PixelLayout::kRgb ? rgb : yuyv_of(rgb);
  segmenter::Config config;
  (void)config.ranges.push_back({1, {5'500}, {7'000}, {2'300}, {3'600}, 20, 255});
  const auto segmenter = std::make_unique<segmenter::Segmenter>(config);
  const bus::Picture picture{layout, kColumns, kRows, bytes.size() / kRows, bytes, {}};
  for ([[maybe_unused]] auto _ : state) {
    const auto frame = segmenter->segment(picture);
    if (!frame || frame->blobs.size() != 4) state.SkipWithError("there are four blocks");
  }
  state.SetItemsProcessed(state.iterations());
}
void segmenter_yuyv(benchmark::State& state) { run_segmenter(state, bus::PixelLayout::kYuyvFull); }
void segmenter_rgb(benchmark::State& state) { run_segmenter(state, bus::PixelLayout::kRgb); }

/// Colour space, thresholds, connected components: three passes.
void opencv_rgb(benchmark::State& state) {
  std::vector<std::uint8_t> rgb = blocks();
  const cv::Mat picture(kRows, kColumns, CV_8UC3, rgb.data());
  cv::Mat yuv;
  cv::Mat mask;
  cv::Mat labels;
  cv::Mat sizes;
  cv::Mat middles;
  cv::setNumThreads(1);
  for ([[maybe_unused]] auto _ : state) {
    cv::cvtColor(picture, yuv, cv::COLOR_RGB2YCrCb);
    cv::inRange(yuv, cv::Scalar(40, 170, 40), cv::Scalar(255, 255, 110), mask);
    if (cv::connectedComponentsWithStats(mask, labels, sizes, middles, 8, CV_32S) != 5) {
      state.SkipWithError("there are four blocks");
    }
  }
  state.SetItemsProcessed(state.iterations());
}

BENCHMARK(segmenter_yuyv);
BENCHMARK(segmenter_rgb);
BENCHMARK(opencv_rgb);

}  // namespace
}  // namespace fencepost::bench

BENCHMARK_MAIN();
