// Figures of models of which nothing is left.
#include <gtest/gtest.h>

#include "host/paper/figure.hpp"
#include "tests/host/paper/worlds.hpp"

namespace fencepost::host {
namespace {

const std::vector<std::size_t> kImages{2, 8, 75};

/// Cylinders have R 0.06 and P 0.15, all other models R 0.2 and P 0.02; space carving ends empty if so asked.
SequenceData sequence(const Tour& tour, bool carved_away) {
  SequenceData data;
  data.tour = tour;
  data.after = kImages;
  const std::vector<double> thoroughness(kImages.back(), 0.5);
  data.thoroughness = {thoroughness, thoroughness};
  for (std::size_t a = 0; a < algorithms().size(); ++a) {
    const bool cylinder = algorithms()[a].key == "cylinder";
    const Score good = cylinder ? Score{0.06, 0.15, 0.8, false} : Score{0.2, 0.02, 0.8, false};
    std::vector<Score> scores(kImages.size(), good);
    if (carved_away && algorithms()[a].key == "carving") scores.back() = kEmptyScore;
    data.scores.push_back({scores, scores});
  }
  return data;
}

/// Four scenes, in one of which carving leaves nothing.
PaperData one_of_four() {
  PaperData data;
  data.mean_images = kImages;
  data.shown = follow_sequence(drive(testing::two_squares()), 2, {1, 2, 3});
  for (const bool carved_away : {false, false, true, false}) {
    data.noisy.push_back(sequence(data.shown.tour, carved_away));
    data.ideal.push_back(sequence(data.shown.tour, false));
  }
  data.novelty.resize(algorithms().size());
  data.table.resize(algorithms().size());
  data.table_scenes = 4;
  return data;
}

const Claim& claim(const PaperFigure& figure, const std::string& key) {
  for (const Claim& one : figure.claims) {
    if (one.key == key) return one;
  }
  throw std::out_of_range(key);
}

std::string file(const PaperFigure& figure, const std::string& name) {
  for (const PaperFile& one : figure.files) {
    if (one.name == name) return one.bytes;
  }
  throw std::out_of_range(name);
}

TEST(EmptyModels, HaveNoParanoiaInFigure7) {
  const PaperFigure figure = figure_7(one_of_four());
  const Claim& many = claim(figure, "many images");
  EXPECT_EQ(many.kind, ClaimKind::kDiffers) << many.text;
  EXPECT_NE(many.text.find("R 6.0 % against 40.0 %, P 15.0 % against 2.0 %. Empty, and without P: 1 of 4 by "),
            std::string::npos)
      << many.text;
  EXPECT_NE(claim(figure, "few images").text.find("No model is empty."), std::string::npos);
  const std::string csv = file(figure, "fig07.csv");
  EXPECT_NE(csv.find("noisy,75,carving,0.4000,0.0200,0.6000,1,4\n"), std::string::npos) << csv;
  EXPECT_NE(csv.find("noisy,75,cylinder,0.0600,0.1500,0.8000,0,4\n"), std::string::npos) << csv;
}

TEST(EmptyModels, AloneLeaveADashForTheirParanoia) {
  PaperData data = one_of_four();
  data.noisy = {data.noisy[2]};
  const PaperFigure figure = figure_7(data);
  EXPECT_NE(claim(figure, "many images").text.find("P 15.0 % against \u2013."), std::string::npos);
  EXPECT_NE(file(figure, "fig07.csv").find("noisy,75,carving,1.0000,,0.0000,1,1\n"), std::string::npos);
}

TEST(EmptyModels, AreCountedInFigures10And13) {
  PaperData data = one_of_four();
  const std::size_t carving = algorithm_index("carving").value();
  data.table[carving].empty = {0, 3};
  EXPECT_NE(file(figure_10(data), "fig10.csv").find("yellow,empty models,carving,3,4,,\n"), std::string::npos);
  for (SequenceData& scene : data.noisy) scene.scores[carving][kYellowLandmark][1] = kEmptyScore;
  data.shown.tour.frames.resize(8);
  EXPECT_NE(figure_13(data).html.find(">4 of 4<"), std::string::npos);
}

TEST(EmptyModels, AreNamedInFigure12) {
  PaperData data = one_of_four();
  data.sequence.assign(algorithms().size(), Sequence(2));
  for (auto& landmarks : data.shown.scores) landmarks.assign(2, {Score{0.1, 0.1, 0.8, false}});
  EXPECT_EQ(figure_12(data).html.find("Empty"), std::string::npos);
  const std::size_t carving = algorithm_index("carving").value();
  data.shown.scores[carving][kRedLandmark].back() = kEmptyScore;
  EXPECT_NE(figure_12(data).html.find("Empty, so that nothing is rendered: red by "), std::string::npos);
}

TEST(EmptyModels, AreOutOfTheTrendsOfParanoia) {
  const PaperFigure figure = figure_14(one_of_four());
  EXPECT_NE(figure.html.find(">1 of 12<"), std::string::npos);
  const std::string csv = file(figure, "fig14.csv");
  EXPECT_NE(csv.find("carving,0.5000,1.0000,\n"), std::string::npos) << csv;
  EXPECT_NE(file(figure, "fig14_parts.csv").find("carving,paranoia,0.5000,11,0.0200,"), std::string::npos)
      << file(figure, "fig14_parts.csv");
}

}  // namespace
}  // namespace fencepost::host
