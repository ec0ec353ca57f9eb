// The cost of a camera's pitch: the table in host/share/doc/frames.md, computed again.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <numbers>
#include <sstream>

#include "host/evaluate/evaluate.hpp"
#include "host/scene/load.hpp"
#include "host/simulate/simulate.hpp"

namespace fencepost::host {
namespace {

/// Cells of the table's row that begins with `head`.
std::vector<std::string> row_of(const std::string& head) {
  std::ifstream file(FENCEPOST_SOURCE_DIR "/host/share/doc/frames.md");
  std::string line;
  while (std::getline(file, line) && !line.starts_with("| " + head + " |")) {
  }
  std::vector<std::string> cells;
  std::istringstream rest(line);
  for (std::string cell; std::getline(rest, cell, '|');) cells.push_back(cell);
  if (cells.size() < 3) return {};
  return {cells.begin() + 2, cells.end()};
}

struct Reached {
  double iou = 0;
  std::uint64_t found = 0;
};

/// The bundled arc, with a camera whose true pitch is `degrees`; `given`: what the robot is given.
Reached reached(double degrees, const std::string& given) {
  const LoadedScene loaded = load_scene(FENCEPOST_SOURCE_DIR "/host/share/recordings/blocks_arc.json");
  EXPECT_TRUE(loaded.ok());
  Scene scene = *loaded;
  const double pitch = degrees * std::numbers::pi / 180;
  scene.camera.mount.pitch = base::Radians::nearest(given == "known" ? pitch : 0);
  if (given != "known") scene.noise.pitch_error = pitch;
  if (given == "unknown") scene.camera.mount.pitch.reset();
  std::string log;
  EXPECT_TRUE(simulate(scene, [&](std::string_view line) { log += line; }));
  const EvaluateOutcome outcome = evaluate(log, "pitch", scene, {});
  const Summary summary = summarise({&outcome.evaluation, 1}, {});
  const auto row = std::ranges::find_if(
      summary.rows, [](const SummaryRow& one) { return one.model == "hybrid" && !one.views.has_value(); });
  EXPECT_NE(row, summary.rows.end());
  return {row->iou.mean, summary.found};
}

TEST(Pitch, CostsWhatTheDocumentSays) {
  const std::vector<std::string> degrees = row_of("true pitch, degrees");
  std::size_t compared = 0;
  for (const std::string given : {"known", "unknown", "given as 0"}) {
    const std::vector<std::string> cells = row_of(given);
    ASSERT_EQ(cells.size(), degrees.size()) << given;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const Reached now = reached(std::stod(degrees[i]), given);
      EXPECT_NEAR(now.iou, std::stod(cells[i]), 0.01) << given << degrees[i];
      const bool all = cells[i].find('(') == std::string::npos;
      EXPECT_EQ(now.found == 3, all) << given << degrees[i] << now.found;
      ++compared;
    }
  }
  EXPECT_GE(compared, 15U);
}

}  // namespace
}  // namespace fencepost::host
