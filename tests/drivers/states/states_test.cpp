// All decoders: from each control state each byte, to a fixed point. What the walks find is compared with walked.csv.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "tests/drivers/states/planted.hpp"
#include "tests/drivers/states/walks.hpp"

namespace fencepost::test {
namespace {

const std::string kTable = FENCEPOST_SOURCE_DIR "/tests/drivers/states/walked.csv";

std::string row_of(const NamedWalk& walk, const Walked& walked) {
  return name_of(walk) + ";" + std::to_string(walked.states) + ";" + std::to_string(walked.transitions) + ";" +
         std::to_string(walked.way_back);
}

std::set<std::string> known_rows() {
  std::ifstream file(kTable);
  std::set<std::string> rows;
  for (std::string row; std::getline(file, row);) rows.insert(row);
  return rows;
}

/// A driver's own tests may walk its decoder.
bool walks_itself(const std::string& driver) {
  for (const auto& entry : std::filesystem::directory_iterator(FENCEPOST_SOURCE_DIR "/tests/drivers/" + driver)) {
    std::ostringstream text;
    text << std::ifstream(entry.path()).rdbuf();
    if (text.str().find("test::walk(") != std::string::npos) return true;
  }
  return false;
}

class States : public testing::TestWithParam<NamedWalk> {};

TEST_P(States, EachByteInEachState) {
  SCOPED_TRACE(name_of(GetParam()));
  const Walked walked = GetParam().run();
  EXPECT_EQ(walked.trouble, "");
  EXPECT_TRUE(known_rows().contains(row_of(GetParam(), walked))) << kTable << " has another row than\n"
                                                                 << row_of(GetParam(), walked);
}

INSTANTIATE_TEST_SUITE_P(All, States, testing::ValuesIn(named_walks()));

// FENCEPOST_DRIVERS is the list of drivers/CMakeLists.txt.
TEST(StatesOfAll, NoDriverIsForgotten) {
  std::set<std::string_view> walked;
  for (const NamedWalk& walk : named_walks()) walked.insert(walk.driver);
  std::istringstream drivers(FENCEPOST_DRIVERS);
  std::size_t count = 0;
  for (std::string driver; drivers >> driver; ++count)
    EXPECT_TRUE(walked.contains(driver) || walks_itself(driver)) << driver;
  EXPECT_GE(count, 11U);
}

TEST(StatesOfAll, EveryRowIsOfAWalk) {
  std::set<std::string> names;
  for (const NamedWalk& walk : named_walks()) names.insert(name_of(walk));
  std::size_t rows = 0;
  for (const std::string& row : known_rows()) rows += names.contains(row.substr(0, row.find(';')));
  EXPECT_EQ(rows, named_walks().size());
  EXPECT_EQ(known_rows().size(), rows + 1) << "and the heading";
}

TEST(StatesOfAPlantedDecoder, TheRightOneHasNoTrouble) {
  const Walked walked = walk(PlantedSubject<kPlantedRoom>{}, planted_plan());
  EXPECT_EQ(walked.trouble, "");
  EXPECT_GT(walked.states, 2 * kPlantedRoom);
}

TEST(StatesOfAPlantedDecoder, APayloadOneByteTooLongIsFound) {
  const Walked walked = walk(PlantedSubject<kPlantedRoom + 1>{}, planted_plan());
  EXPECT_NE(walked.trouble.find("written behind"), std::string::npos) << walked.trouble;
}

// No sample is that long: the walk goes there by itself.
TEST(StatesOfAPlantedDecoder, ALineOneByteTooLongIsFound) {
  const Walked walked = walk(PlantedSubject<kPlantedRoom, kPlantedLine + 1>{}, planted_plan());
  EXPECT_NE(walked.trouble.find("written behind"), std::string::npos) << walked.trouble;
}

TEST(StatesOfAPlantedDecoder, APayloadOneByteTooShortIsFound) {
  const Walked walked = walk(PlantedSubject<kPlantedRoom - 1>{}, planted_plan());
  EXPECT_NE(walked.trouble.find("0 messages, not 1"), std::string::npos) << walked.trouble;
}

TEST(StatesOfAPlantedDecoder, AWaitWithoutEndIsFound) {
  Plan plan = planted_plan();
  plan.way_back = 3;  // as if it had none of a whole payload to wait for
  EXPECT_NE(walk(PlantedSubject<kPlantedRoom>{}, plan).trouble.find("not understood"), std::string::npos);
}

}  // namespace
}  // namespace fencepost::test
