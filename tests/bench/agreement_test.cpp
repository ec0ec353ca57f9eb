#include "tests/bench/agreement.hpp"

#include <gtest/gtest.h>

namespace fencepost::test {
namespace {

using bench::Contender;

std::string joined(const std::vector<std::string>& lines) {
  std::string all;
  for (const std::string& line : lines) all += line + "\n";
  return all;
}

TEST(BenchAgreement, OurKernelsGeosAndOpenCvGiveTheSameAreas) {
  for (const std::size_t objects : {4U, 8U}) {
    const bench::Workload workload = bench::workload(objects);
    ASSERT_EQ(workload.size(), objects);
    std::vector<Contender> contenders{bench::our_clip(workload), bench::sutherland_hodgman(workload),
                                      bench::our_model(workload), bench::geos(workload)};
    for (const std::size_t cells : {64U, 128U, 256U}) {
      contenders.push_back(bench::our_carving(workload, cells));
      contenders.push_back(bench::our_dense_carving(workload, cells));
      contenders.push_back(bench::opencv(workload, cells));
      contenders.push_back(bench::limit(workload, cells));
    }
    EXPECT_EQ(joined(bench::disagreements(workload, contenders)), "");
  }
}

// The clip of these views is the object, grown by 2 mrad at 0.7 to 1.7 m.
TEST(BenchAgreement, TheWorkloadLeavesTheObjects) {
  const bench::Workload workload = bench::workload(4);
  const Contender clip = bench::our_clip(workload);
  clip.run();
  const std::vector<double> areas = clip.areas();
  ASSERT_EQ(areas.size(), 4U);
  // A square of radius 0.1 has 0.02 m^2.
  EXPECT_GT(areas[2], 0.02);
  EXPECT_LT(areas[2], 0.0225);
}

TEST(BenchAgreement, AnAreaThatIsOffIsFound) {
  const bench::Workload workload = bench::workload(4);
  Contender wrong = bench::our_clip(workload);
  wrong.areas = [right = wrong.areas] {
    std::vector<double> areas = right();
    areas[3] *= 1.001;
    return areas;
  };
  const std::vector<Contender> contenders{wrong};
  const std::vector<std::string> faults = bench::disagreements(workload, contenders);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_NE(faults[0].find("object 3"), std::string::npos) << faults[0];
}

}  // namespace
}  // namespace fencepost::test
