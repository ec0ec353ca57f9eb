#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <regex>
#include <set>

#include "host/paper/paper.hpp"
#include "tests/host/report/markup_checker.hpp"

namespace fencepost::host {
namespace {

PaperOptions few_scenes() {
  PaperOptions options;
  options.seed = 5;
  options.scenes = 2;
  options.mean_scenes = 2;
  options.single_scenes = 1;
  options.generator = "test & <check>";
  return options;
}

const std::map<std::string, std::string>& files() {
  static const std::map<std::string, std::string> all = [] {
    std::map<std::string, std::string> by_name;
    for (const PaperFile& file : write_paper(few_scenes())) by_name[file.name] = file.bytes;
    return by_name;
  }();
  return all;
}

const std::string& page() { return files().at("index.html"); }

/// Values of an attribute of the page.
std::set<std::string> values_of(const std::string& attribute) {
  std::set<std::string> values;
  const std::string start = attribute + "=\"";
  for (std::size_t at = page().find(start); at != std::string::npos; at = page().find(start, at + 1)) {
    const std::size_t begin = at + start.size();
    values.insert(page().substr(begin, page().find('"', begin) - begin));
  }
  return values;
}

TEST(WritePaper, GivesTheSameBytesEachTime) {
  const std::vector<PaperFile> again = write_paper(few_scenes());
  EXPECT_EQ(again.size(), files().size()) << "each file is named once";
  for (const PaperFile& file : again) EXPECT_EQ(file.bytes, files().at(file.name)) << file.name;
}

TEST(WritePaper, GivesOtherBytesForAnotherSeed) {
  PaperOptions options = few_scenes();
  options.seed = 6;
  options.single_scenes = 0;
  const std::string other = write_paper(options).front().bytes;
  EXPECT_NE(other, page());
  EXPECT_EQ(other.find("taken alone"), std::string::npos);
}

TEST(WritePaper, HasEveryFigureOfThePaper) {
  for (const std::string number : {"4", "5", "6", "7", "8", "9", "10", "11", "12", "12b", "13", "14"}) {
    EXPECT_NE(page().find("<section id=\"fig" + number + "\">"), std::string::npos) << number;
    const std::string csv = "fig" + std::string(number[0] > '3' && number.size() == 1 ? "0" : "") + number + ".csv";
    EXPECT_TRUE(files().contains(csv)) << csv;
  }
}

TEST(WritePaper, IsWellFormed) {
  EXPECT_EQ(testing::find_fault(page()), "");
  EXPECT_NE(page().find("test &amp; &lt;check&gt;"), std::string::npos);
  for (const auto& [name, bytes] : files()) {
    if (name.ends_with(".svg")) {
      EXPECT_EQ(testing::find_fault(bytes.substr(bytes.find("<svg"))), "") << name;
    }
  }
}

TEST(WritePaper, LinksToFilesThatAreThereAndToNothingElse) {
  std::size_t links = 0;
  for (const std::string attribute : {"src", "href"}) {
    for (const std::string& value : values_of(attribute)) {
      if (value.starts_with('#')) continue;
      EXPECT_TRUE(files().contains(value)) << value;
      ++links;
    }
  }
  EXPECT_GT(links, 30U);
}

TEST(WritePaper, HasPicturesThatArePng) {
  std::size_t pictures = 0;
  for (const auto& [name, bytes] : files()) {
    if (!name.ends_with(".png")) continue;
    EXPECT_EQ(bytes.substr(0, 8), "\x89PNG\r\n\x1A\n") << name;
    ++pictures;
  }
  EXPECT_GT(pictures, 20U);
}

TEST(WritePaper, HasTablesWithTheirHeadersAndWholeRows) {
  const std::map<std::string, std::string> headers{
      {"fig04.csv", "algorithm,landmark,area_m2,z_min_m,z_max_m,recklessness,paranoia,iou"},
      {"fig05.csv", "landmark,algorithm,recklessness,paranoia,iou"},
      {"fig06.csv", "algorithm,landmark,hue,rgb,width,height,shape,location,error"},
      {"fig07.csv", "scenes,image,algorithm,recklessness,paranoia,iou,empty,models"},
      {"fig08.csv", "image,algorithm,landmark,error,match_confidence,outcome"},
      {"fig09.csv", "outcome,correct,world,seed,image,algorithm,landmark,error"},
      {"fig10.csv", "landmark,result,algorithm,wrong,all,right_percent,paper_percent"},
      {"fig11.csv", "world,seed,image,algorithm,landmark,error,match_confidence"},
      {"fig12.csv", "image,landmark,algorithm,error,match_confidence,margin,outcome"},
      {"fig12b.csv", "image,landmark,thoroughness,novelty"},
      {"fig13.csv", "algorithm,images,novelty,match_confidence"},
      {"fig14.csv", "algorithm,thoroughness,recklessness,paranoia"},
      {"fig14_parts.csv", "algorithm,measure,thoroughness,n,mean,deviation"}};
  for (const auto& [name, header] : headers) {
    const std::string& text = files().at(name);
    EXPECT_EQ(text.substr(0, text.find('\n')), header) << name;
    const auto commas = std::count(header.begin(), header.end(), ',');
    for (std::size_t begin = 0; begin < text.size(); begin = text.find('\n', begin) + 1) {
      const std::string row = text.substr(begin, text.find('\n', begin) - begin);
      EXPECT_EQ(std::count(row.begin(), row.end(), ','), commas) << name << ": " << row;
    }
  }
}

TEST(WritePaper, ComparesEveryAlgorithmInEveryTable) {
  for (const std::string name : {"fig05.csv", "fig07.csv", "fig10.csv", "fig12.csv", "fig13.csv", "fig14.csv"}) {
    for (const Algorithm& algorithm : algorithms()) {
      EXPECT_NE(files().at(name).find(std::string(algorithm.key) + ","), std::string::npos) << name;
    }
  }
}

TEST(WritePaper, SaysInHowManyScenesASentenceHolds) {
  const std::regex counted("Holds in ([0-9]+) of ([0-9]+) scenes taken alone");
  std::size_t sentences = 0;
  for (std::sregex_iterator it(page().begin(), page().end(), counted); it != std::sregex_iterator(); ++it) {
    EXPECT_LE(std::stoi((*it)[1]), std::stoi((*it)[2]));
    EXPECT_EQ(std::stoi((*it)[2]), 1);
    ++sentences;
  }
  EXPECT_GT(sentences, 30U);  // each twice: in the summary and below its figure
}

// Figure 9: an example of each of the six outcomes, as a picture of what was taken and one of what was rendered.
TEST(WritePaper, ShowsTheSixOutcomes) {
  std::size_t shown = 0;
  for (const MatchOutcome outcome : {MatchOutcome::kMatched, MatchOutcome::kUnmatched, MatchOutcome::kUnseen,
                                     MatchOutcome::kMismatched, MatchOutcome::kMissed, MatchOutcome::kUnrendered}) {
    const std::string prefix = "fig09_" + std::string(name(outcome));
    EXPECT_EQ(files().contains(prefix + "_real.png"), files().contains(prefix + "_rendered.png")) << prefix;
    if (files().contains(prefix + "_real.png")) ++shown;
  }
  EXPECT_GE(shown, 5U);
  // An outcome without an example is named.
  EXPECT_EQ(shown < 6, page().find("There is no example of: ") != std::string::npos);
}

TEST(WritePaper, CountsEveryDecisionOfTheTable) {
  // Two scenes of 75 images, for each landmark and algorithm.
  for (const Algorithm& algorithm : algorithms()) {
    const std::string row = "red,all," + std::string(algorithm.key) + ",";
    const std::string& text = files().at("fig10.csv");
    const std::size_t at = text.find(row);
    ASSERT_NE(at, std::string::npos) << algorithm.key;
    const std::size_t all = text.find(',', at + row.size()) + 1;
    EXPECT_EQ(text.substr(all, 4), "150,");
  }
  EXPECT_NE(files().at("fig10.csv").find(",91.78\n"), std::string::npos);  // the paper's own, beside ours
}

}  // namespace
}  // namespace fencepost::host
