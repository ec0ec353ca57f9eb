#include "tests/studies/tables/comparison.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

namespace fencepost::test {
namespace {

// A scene of as many objects as scores, each measured at its end.
host::Evaluation scene_of(const std::vector<host::Score>& scores) {
  host::Evaluation scene;
  scene.models = {"clip"};
  for (const host::Score& score : scores) {
    host::ObjectEvaluation& object = scene.objects.emplace_back();
    object.found = host::FoundObject{};
    object.cuts.push_back({75, true, {}, {{"clip", score}}});
  }
  return scene;
}

// Two scenes of 1 and 3 objects: R = (0.1 + 3 * 0.3) / 4 = 25 %, P = (0.2 + 3 * 0.4) / 4 = 35 %. Their sums 30 and 70
// are 30 below and 10 above 60; weighted 30/4 and 3*10/4, both 7.5: variance (7.5^2 + 7.5^2) * 2/1 = 15^2. The
// reference of 100 scenes adds 2/100 of it.
TEST(Comparison, WeighsObjectsAndTakesScenesForTheError) {
  const std::vector<host::Evaluation> scenes{scene_of({{0.1, 0.2, 0}}),
                                             scene_of({{0.3, 0.4, 0}, {0.3, 0.4, 0}, {0.3, 0.4, 0}})};
  const std::vector<ReferenceCell> reference{{"2", "clip", std::nullopt, 20, 30}, {"3", "clip", std::nullopt, 1, 1}};
  const std::vector<ComparedCell> cells = compare("2", scenes, reference);
  ASSERT_EQ(cells.size(), 1U);
  EXPECT_NEAR(cells[0].recklessness, 25, 1e-9);
  EXPECT_NEAR(cells[0].paranoia, 35, 1e-9);
  EXPECT_NEAR(cells[0].error, 15 * std::sqrt(1.02), 1e-9);
  EXPECT_NEAR(cells[0].worse_by(), 10, 1e-9);
  EXPECT_TRUE(cells[0].misses());
  EXPECT_FALSE(cells[0].fails());
}

TEST(Comparison, FailsBeyondTwoPointsAndTwoStandardErrors) {
  ComparedCell cell{{"0", "clip", 2, 10, 20}, 12, 19.9, 1};  // 1.9 worse
  EXPECT_FALSE(cell.misses());
  cell.recklessness = 16;  // 5.9 worse
  EXPECT_TRUE(cell.misses());
  EXPECT_TRUE(cell.fails());
  cell.error = 2;
  EXPECT_FALSE(cell.fails());
}

TEST(Comparison, SaysWhatItCannotCompare) {
  const std::vector<ReferenceCell> reference{{"2", "sheaf", std::nullopt, 20, 30}};
  const std::vector<host::Evaluation> scenes{scene_of({{}}), scene_of({{}})};
  EXPECT_THROW(static_cast<void>(compare("2", scenes, reference)), std::runtime_error);
  const std::vector<ReferenceCell> clip{{"2", "clip", std::nullopt, 20, 30}};
  EXPECT_THROW(static_cast<void>(compare("2", std::span(scenes).first(1), clip)), std::runtime_error);
}

TEST(Reference, HasEveryCellOnce) {
  const std::vector<ReferenceCell> cells = load_reference(FENCEPOST_REFERENCE);
  EXPECT_EQ(cells.size(), 7U * 5U * 5U);
  for (const ReferenceCell& cell : cells) {
    const auto same = std::count_if(cells.begin(), cells.end(), [&](const ReferenceCell& other) {
      return other.level == cell.level && other.model == cell.model && other.views == cell.views;
    });
    EXPECT_EQ(same, 1) << cell.level << ' ' << cell.model;
  }
}

std::string complaint_about(const std::string& line) {
  const std::string path = ::testing::TempDir() + "/reference_under_test.csv";
  std::ofstream(path) << "# comment\nlevel,model,views,recklessness,paranoia\n" << line;
  try {
    static_cast<void>(load_reference(path));
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

TEST(Reference, RefusesWhatIsNoFigure) {
  EXPECT_EQ(complaint_about("0,clip,75,1.5,2\n"), "");
  EXPECT_NE(complaint_about("0,clip,75,1.5\n").find("line 3: not five fields"), std::string::npos);
  EXPECT_NE(complaint_about("9,clip,75,1,2\n").find("no noise level"), std::string::npos);
  EXPECT_NE(complaint_about("0,clip,5,1,2\n").find("no column"), std::string::npos);
  EXPECT_NE(complaint_about("0,clip,75,1x,2\n").find("no number"), std::string::npos);
  EXPECT_NE(complaint_about("0,clip,75,1,101\n").find("outside 0..100"), std::string::npos);
  EXPECT_NE(complaint_about("").find("no figures"), std::string::npos);
}

}  // namespace
}  // namespace fencepost::test
