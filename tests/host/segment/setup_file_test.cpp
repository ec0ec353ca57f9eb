#include "host/segment/setup_file.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "firmware/record/encode.hpp"
#include "host/segment/image_file.hpp"
#include "tests/host/segment/pictures.hpp"

namespace fencepost::host {
namespace {

template <class Record>
std::string line_of(const Record& record) {
  std::array<char, record::kMaxLine> line{};
  return {line.data(), record::encode(record, line)};
}

constexpr const char* kCamera =
    R"({"camera": {"width": 160, "height": 120, "fx": 150, "fy": 150, "cx": 79.5, "cy": 59.5}})";
constexpr const char* kSignatures = R"({"signatures": [{"id": 4, "name": "red", "rgb": "c81e1e"}]})";

TEST(SetupFile, TheCameraComesFromABlockASceneOrALine) {
  EXPECT_EQ(parse_camera(kCamera, "c").width, 160);
  EXPECT_EQ(parse_camera(R"({"format": 1, "objects": "anything", "camera": {"width": 160, "height": 120, "fx": 150,
                             "fy": 150, "cx": 79.5, "cy": 59.5}})",
                         "c")
                .height,
            120);
  const sensor::CameraIntrinsics camera = camera_of(160, 120);
  std::string line = line_of(camera);
  EXPECT_EQ(parse_camera(line, "c"), camera);
  line.resize(line.size() - 2);
  EXPECT_EQ(parse_camera(line, "c"), camera) << "pasted without its line end";
}

TEST(SetupFile, SignaturesComeFromTheSamePlaces) {
  const std::vector<record::Signature> from_json = parse_signatures(kSignatures, "s");
  ASSERT_EQ(from_json.size(), 1U);
  EXPECT_EQ(from_json[0], given(4, "red", kRed));
  const std::string lines =
      line_of(given(4, "red", kRed)) + line_of(given(2, "blue", kBlue)) + line_of(given(4, "red", kRed));
  const std::vector<record::Signature> from_lines = parse_signatures(lines, "s");
  ASSERT_EQ(from_lines.size(), 2U) << "repeats, as logs have them, are one";
  EXPECT_EQ(from_lines[1].signature, 2);
}

TEST(SetupFile, ASignatureOfJsonKeepsItsSizeAndPad) {
  const auto read = parse_signatures(R"({"signatures": [{"id": 4, "rgb": "c81e1e", "size": 0.05, "pad": -3}]})", "s");
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read[0].width, 50) << "mm";
  EXPECT_EQ(read[0].pad, -3);
}

TEST(SetupFile, ColoursComeFromTheCommandLine) {
  EXPECT_EQ(parse_colour("red=C81e1e", 3), given(3, "red", kRed));
  EXPECT_EQ(parse_rgb("808080", "x"), kGrey);
}

std::string complaint(const std::function<void()>& parse) {
  try {
    parse();
  } catch (const SegmentProblem& problem) {
    EXPECT_FALSE(problem.remedy.empty());
    return problem.message();
  }
  return "none";
}

TEST(SetupFile, ComplaintsNameThePlace) {
  const auto camera = [](const char* text) { return complaint([=] { (void)parse_camera(text, "f"); }); };
  const auto signatures = [](const char* text) { return complaint([=] { (void)parse_signatures(text, "f"); }); };
  const auto colour = [](const char* text) { return complaint([=] { (void)parse_colour(text, 1); }); };
  EXPECT_EQ(camera("").rfind("f: has no calibration", 0), 0U);
  EXPECT_EQ(camera("$FPCAM,1*0000\n").rfind("f: has no calibration", 0), 0U);
  EXPECT_EQ(camera("{").rfind("f: line 1", 0), 0U);
  EXPECT_NE(camera("{}").find("camera"), std::string::npos);
  EXPECT_NE(camera(R"({"camera": {"width": 1}})").find("/camera/width"), std::string::npos);
  EXPECT_EQ(signatures("").rfind("f: has no signatures", 0), 0U);
  EXPECT_NE(signatures(R"({"signatures": []})").find("/signatures"), std::string::npos);
  EXPECT_NE(signatures(R"({"signatures": [{"id": 1, "rgb": "x"}]})").find("is not a colour"), std::string::npos);
  EXPECT_NE(signatures(R"({"signatures": [{"id": 1, "rgb": "000000"}, {"id": 1, "rgb": "ffffff"}]})").find("twice"),
            std::string::npos);
  EXPECT_NE(colour("red").find("NAME=RRGGBB"), std::string::npos);
  EXPECT_NE(colour("=ff0000").find("NAME=RRGGBB"), std::string::npos);
  EXPECT_NE(colour("red=ff00").find("is not a colour"), std::string::npos);
  EXPECT_NE(colour("red=gg0000").find("is not a colour"), std::string::npos);
}

}  // namespace
}  // namespace fencepost::host
