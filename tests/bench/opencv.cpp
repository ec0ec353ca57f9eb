#include <cmath>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/core/version.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/bench/contender.hpp"

namespace fencepost::bench {

// A byte a cell: the filled triangle of each view, and the cells that were solid before.
Contender opencv(const Workload& workload, std::size_t cells) {
  constexpr int kBits = 4;  // of a cell, that corners are given to
  struct State {
    cv::Mat mask;
    std::vector<cv::Mat> grids;
  };
  const auto state = std::make_shared<State>();
  const auto side = static_cast<int>(cells);
  state->mask.create(side, side, CV_8U);
  state->grids.resize(workload.size());
  for (cv::Mat& grid : state->grids) grid.create(side, side, CV_8U);
  const double low = arena()[0].x;
  const double cell = (arena()[1].x - low) / side;
  const auto run = [state, &workload, low, cell] {
    for (std::size_t o = 0; o < workload.size(); ++o) {
      state->grids[o].setTo(255);
      for (const View& view : workload[o].views) {
        std::array<cv::Point, 3> corners;
        for (std::size_t i = 0; i < 3; ++i) {
          const auto fixed = [&](double at) {
            return static_cast<int>(std::lround(((at - low) / cell - 0.5) * (1 << kBits)));
          };
          corners[i] = {fixed(view.triangle[i].x), fixed(view.triangle[i].y)};
        }
        state->mask.setTo(0);
        cv::fillConvexPoly(state->mask, corners.data(), 3, 255, cv::LINE_8, kBits);
        cv::bitwise_and(state->grids[o], state->mask, state->grids[o]);
      }
    }
  };
  const auto areas = [state, cell] {
    std::vector<double> all;
    for (const cv::Mat& grid : state->grids) all.push_back(cv::countNonZero(grid) * cell * cell);
    return all;
  };
  return {"OpenCV " CV_VERSION, Kind::kGrid, cells, run, areas};
}

}  // namespace fencepost::bench
