// WPILOG files written byte by byte, as the formats of WPILib, PhotonVision and Limelight have them.
#include "host/import/wpilog/wpilog.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "tests/host/import/takes.hpp"

namespace fencepost::host::wpilog {
namespace {

/// Little-endian.
template <class Integer>
std::string bytes_of(Integer value) {
  std::string text;
  for (std::size_t i = 0; i < sizeof value; ++i) {
    text += static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * i) & 0xFFU);
  }
  return text;
}
std::string real(double value) { return bytes_of(std::bit_cast<std::uint64_t>(value)); }
std::string reals(std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) text += real(value);
  return text;
}
std::string string(const std::string& text) { return bytes_of(static_cast<std::uint32_t>(text.size())) + text; }

std::string header() { return "WPILOG" + bytes_of<std::uint16_t>(0x0100) + string("AdvantageKit"); }
/// Numbers of one, one and four bytes: 0x30 says so.
std::string record(unsigned entry, double t, const std::string& data) {
  return "\x30" + bytes_of(static_cast<std::uint8_t>(entry)) + bytes_of(static_cast<std::uint8_t>(data.size())) +
         bytes_of(static_cast<std::uint32_t>(std::lround(1e6 * t))) + data;
}
/// Numbers of four, four and eight bytes.
std::string long_record(unsigned entry, double t, const std::string& data) {
  return "\x7F" + bytes_of(static_cast<std::uint32_t>(entry)) + bytes_of(static_cast<std::uint32_t>(data.size())) +
         bytes_of(static_cast<std::uint64_t>(std::llround(1e6 * t))) + data;
}
std::string start(unsigned entry, const std::string& name, const std::string& type) {
  return long_record(
      0, 0,
      std::string(1, '\0') + bytes_of(static_cast<std::uint32_t>(entry)) + string(name) + string(type) + string("{}"));
}

std::string corners(std::initializer_list<double> values) {
  return bytes_of(static_cast<std::uint8_t>(values.size() / 2)) + reals(values);
}
struct PhotonTarget {
  int tag = -1;
  int kind = -1;
  std::string smallest = corners({});
  std::string detected = corners({});
  double yaw = 0;
};
std::string photon(const std::vector<PhotonTarget>& targets, std::int64_t latency_us = 30'000, bool multitag = false) {
  std::string text = bytes_of<std::int64_t>(7) + bytes_of<std::int64_t>(1'000'000) + bytes_of(1'000'000 + latency_us) +
                     bytes_of<std::int64_t>(0) + bytes_of(static_cast<std::uint8_t>(targets.size()));
  for (const PhotonTarget& target : targets) {
    text += reals({target.yaw, 0, 1.5, 0}) + bytes_of(static_cast<std::int32_t>(target.tag)) +
            bytes_of(static_cast<std::int32_t>(target.kind)) + std::string(4, '\0') + std::string(2 * 56, '\0') +
            real(0.1) + target.smallest + target.detected;
  }
  if (!multitag) return text + '\0';
  return text + '\1' + std::string(17 * 8, '\0') + bytes_of<std::uint8_t>(2) + std::string(4, '\0');
}
const std::string kPhotonType = "photonstruct:PhotonPipelineResult:4b2ff16a964b5e2bf01be0c1454d91c4";
const std::string kPhotonName = "NT:/photonvision/front/rawBytes";

ImportResult imported(const std::string& records, const WpilogTopics& topics = {}) {
  return import_wpilog(header() + records, "run.wpilog", topics, settings(640, 480, 500));
}
bool noted(const ImportResult& result, const std::string& words) {
  for (const std::string& note : result->summary.notes) {
    if (note.find(words) != std::string::npos) return true;
  }
  return false;
}
std::string drive() {
  return start(1, "/RealOutputs/Odometry/Robot", "struct:Pose2d") + record(1, 10, reals({1, 2, 0.5})) +
         record(1, 10.1, reals({1.1, 2, 0.5}));
}

TEST(ImportWpilog, TakesPhotonVisionsCornersAtTheTimeOfTheirExposure) {
  const PhotonTarget neural{.kind = 3, .smallest = corners({100, 200, 120, 200, 120, 240, 100, 240})};
  const PhotonTarget coloured{.detected = corners({300, 50, 309, 50, 309, 69, 300, 69})};
  const PhotonTarget tag{.tag = 7,
                         .smallest = corners({0, 0, 5, 0, 5, 5, 0, 5}),
                         .detected = corners({400, 10, 410, 12, 410, 30, 400, 28})};
  const ImportResult result =
      imported(drive() + start(2, kPhotonName, kPhotonType) + long_record(2, 10.08, photon({neural, coloured, tag})) +
               long_record(2, 10.1, photon({}, 30'000, true)));
  const Recorded log = recorded(result);
  ASSERT_EQ(log.frames.size(), 2U);
  ASSERT_EQ(log.frames[0].blobs.size(), 3U);
  EXPECT_EQ(log.frames[0].t.raw, 500) << "0.1 ms; 10.08 s less 30 ms, from the first pose";
  expect_box(log.frames[0].blobs[0], 1, 100, 200, 119, 239);
  expect_box(log.frames[0].blobs[1], 3, 400, 10, 410, 30);
  expect_box(log.frames[0].blobs[2], 2, 300, 50, 309, 69);
  EXPECT_EQ(log.frames[1].blobs.size(), 0U);
  ASSERT_EQ(log.signatures.size(), 3U);
  EXPECT_EQ(log.signatures[0].name.view(), "class 3");
  EXPECT_EQ(log.signatures[1].name.view(), "target");
  EXPECT_EQ(log.signatures[2].name.view(), "tag 7");
  ASSERT_EQ(log.odometry.size(), 2U);
  EXPECT_EQ(log.odometry[1].x.to_double(), 1.1);
  EXPECT_EQ(log.odometry[1].heading.to_double(), 0.5);
  EXPECT_TRUE(noted(result, "boxes are of \"" + kPhotonName + "\""));
  EXPECT_TRUE(noted(result, "poses are of \"/RealOutputs/Odometry/Robot\""));
}

TEST(ImportWpilog, ATargetWithoutCornersIsABearing) {
  const Recorded log = recorded(imported(drive() + start(2, kPhotonName, kPhotonType) +
                                         long_record(2, 10.08, photon({{.yaw = std::atan(0.2) * 180 / M_PI}}))));
  ASSERT_EQ(log.frames.size(), 1U);
  ASSERT_EQ(log.frames[0].blobs.size(), 1U);
  EXPECT_TRUE(log.frames[0].blobs[0].bearing);
  EXPECT_NEAR(log.frames[0].blobs[0].cx.to_double(), 319.5 + 100, 0.051);
}

TEST(ImportWpilog, ResultsOfAnotherLayoutAreCounted) {
  const std::string whole = photon({{.kind = 3, .smallest = corners({100, 200, 120, 240})}});
  std::string records = drive() + start(2, kPhotonName, kPhotonType) + long_record(2, 10.05, whole) +
                        long_record(2, 10.06, whole + "x") + long_record(2, 10.07, std::string(32, '\0') + "\xFF");
  for (std::size_t size = 0; size < whole.size(); ++size) records += long_record(2, 11, whole.substr(0, size));
  const ImportResult result = imported(records);
  EXPECT_EQ(recorded(result).frames.size(), 1U);
  EXPECT_EQ(skipped(result, "results of another layout"), 2 + whole.size());
}

TEST(ImportWpilog, LatenciesThatMakeNoSenseAreNotTaken) {
  const ImportResult result =
      imported(drive() + start(2, kPhotonName, kPhotonType) + long_record(2, 10.02, photon({}, -1)) +
               long_record(2, 10.05, photon({}, std::numeric_limits<std::int64_t>::max() - 1'000'000)));
  const Recorded log = recorded(result);
  ASSERT_EQ(log.frames.size(), 2U);
  EXPECT_EQ(log.frames[1].t.raw, 500);
  EXPECT_EQ(skipped(result, "latencies of less than 0 or more than 1 s"), 2U);
}

const std::string kLimelight = "NT:/limelight-front/";

TEST(ImportWpilog, TakesALimelightsDetectionsWithItsLatency) {
  const ImportResult result =
      imported(drive() + start(2, kLimelight + "tl", "double") + start(3, kLimelight + "cl", "double") +
               start(4, kLimelight + "rawdetections", "double[]") + start(5, kLimelight + "tcornxy", "double[]") +
               record(5, 10, "") + record(2, 10.01, real(20)) + record(3, 10.01, real(30)) +
               record(4, 10.08, reals({2, 5, 1, 0.4, 10, 20, 30, 20, 30, 40, 10, 40})) + record(4, 10.1, ""));
  const Recorded log = recorded(result);
  ASSERT_EQ(log.frames.size(), 2U);
  EXPECT_EQ(log.frames[0].t.raw, 300);
  ASSERT_EQ(log.frames[0].blobs.size(), 1U);
  expect_box(log.frames[0].blobs[0], 1, 10, 20, 29, 39);
  EXPECT_EQ(log.signatures[0].name.view(), "class 2");
  EXPECT_TRUE(noted(result, "--detections takes others: \"" + kLimelight + "tcornxy\""));
}

TEST(ImportWpilog, TakesALimelightsJsonOfBothLayouts) {
  const std::string detector =
      R"("Detector":[{"class":"cone","classID":1,"conf":0.9,"pts":[[10,20],[30,20],[30,40],[10,40]],"tx":1,"ty":2}])";
  const std::string retro = R"("Retro":[{"pts":[[50,60],[69,60],[69,79],[50,79]],"tx":0,"ty":0}])";
  const ImportResult result = imported(drive() + start(2, kLimelight + "json", "string") +
                                       long_record(2, 10.05, "{" + detector + "," + retro + R"(,"tl":20,"cl":10})") +
                                       long_record(2, 10.08, R"({"Results":{)" + detector + "}}") +
                                       long_record(2, 10.09, "[1]") + long_record(2, 10.09, std::string(5000, '[')));
  const Recorded log = recorded(result);
  ASSERT_EQ(log.frames.size(), 2U);
  EXPECT_EQ(log.frames[0].t.raw, 200);
  ASSERT_EQ(log.frames[0].blobs.size(), 2U);
  expect_box(log.frames[0].blobs[0], 1, 10, 20, 29, 39);
  expect_box(log.frames[0].blobs[1], 2, 50, 60, 69, 79);
  EXPECT_EQ(log.signatures[0].name.view(), "cone");
  EXPECT_EQ(skipped(result, "results of another layout"), 2U);
}

TEST(ImportWpilog, TakesALimelightsAnglesAsBearings) {
  const Recorded log =
      recorded(imported(drive() + start(2, kLimelight + "tx", "double") + start(3, kLimelight + "ty", "double") +
                        start(4, kLimelight + "tv", "double") + record(4, 10, real(1)) + record(3, 10, real(45)) +
                        record(2, 10.02, real(-20)) + record(4, 10.04, real(0)) + record(2, 10.04, real(0)) +
                        record(4, 10.05, real(1)) + record(3, 10.05, real(10)) + record(2, 10.05, real(10))));
  ASSERT_EQ(log.frames.size(), 3U);
  EXPECT_EQ(log.frames[0].blobs.size(), 0U) << "45 degrees up is outside of the image";
  EXPECT_EQ(log.frames[1].blobs.size(), 0U);
  ASSERT_EQ(log.frames[2].blobs.size(), 1U);
  EXPECT_TRUE(log.frames[2].blobs[0].bearing);
  EXPECT_NEAR(log.frames[2].blobs[0].cx.to_double(), 319.5 + 500 * std::tan(10 * M_PI / 180), 0.051);
  EXPECT_NEAR(log.frames[2].blobs[0].cy.to_double(), 239.5 - 500 * std::tan(10 * M_PI / 180), 0.051);
}

TEST(ImportWpilog, TakesTheOdometryAmongOtherPosesAndSaysSo) {
  const std::string records =
      start(1, "NT:/AutoTargetPose", "struct:Pose2d") + record(1, 9, reals({5, 5, 0})) +
      start(2, "/Drive/Pose", "struct:Pose3d") + record(2, 10, reals({1, 2, 0, std::cos(0.25), 0, 0, std::sin(0.25)})) +
      start(3, "NT:/SmartDashboard/Field/.type", "string") + record(3, 10, "Field2d") +
      start(4, "NT:/SmartDashboard/Field/Robot", "double[]") + record(4, 10, reals({3, 4, 90})) +
      start(5, "NT:/Other/Robot", "double[]") + record(5, 10, reals({3, 4, 90}));
  const ImportResult chosen = imported(records);
  const Recorded drive = recorded(chosen);
  ASSERT_EQ(drive.odometry.size(), 1U);
  EXPECT_EQ(drive.odometry[0].y.to_double(), 2);
  EXPECT_NEAR(drive.odometry[0].heading.to_double(), 0.5, 1e-4);
  EXPECT_TRUE(noted(chosen, "--odometry takes others: \"NT:/AutoTargetPose\", \"NT:/SmartDashboard/Field/Robot\""));
  const Recorded field = recorded(imported(records, {"", "NT:/SmartDashboard/Field/Robot"}));
  ASSERT_EQ(field.odometry.size(), 1U);
  EXPECT_NEAR(field.odometry[0].heading.to_double(), M_PI / 2, 1e-4);
  const ImportResult missing = imported(records, {"", "NT:/Other/Robot"});
  ASSERT_FALSE(missing.ok());
  EXPECT_NE(missing.error().message().find("has no \"NT:/Other/Robot\" that --odometry can take"), std::string::npos)
      << missing.error().message();
}

TEST(ImportWpilog, PosesThatAreNoneAreLeftOut) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const ImportResult result =
      imported(drive() + record(1, 11, reals({nan, 0, 0})) + record(1, 12, reals({1e300, 0, 0})) +
               record(1, 13, reals({0, 0, 1e300})) + record(1, 14, reals({0, 0})) + record(1, 15, reals({0, 0, 0, 0})));
  EXPECT_EQ(recorded(result).odometry.size(), 2U);
  EXPECT_EQ(skipped(result, "poses that are none"), 5U);
}

TEST(ImportWpilog, AnEntryMayEndAndItsNumberBeUsedAgain) {
  const std::string finish = long_record(0, 11, '\1' + bytes_of<std::uint32_t>(1));
  const ImportResult result = imported(drive() + finish + record(1, 12, reals({9, 9, 9})) +
                                       start(1, "speed", "double") + record(1, 13, reals({9, 9, 9})));
  EXPECT_EQ(recorded(result).odometry.size(), 2U);
  EXPECT_EQ(skipped(result, "records of entries that were not started"), 1U);
}

TEST(ImportWpilog, SaysWhatAFileIsThatHasNothing) {
  const auto error = [](const std::string& bytes) {
    return import_wpilog(bytes, "run.wpilog", {}, settings(640, 480, 500)).error().message();
  };
  EXPECT_NE(error("").find("is no WPILOG"), std::string::npos);
  EXPECT_NE(error("WPILOX" + bytes_of<std::uint16_t>(0x0100)).find("is no WPILOG"), std::string::npos);
  EXPECT_NE(error("WPILOG" + bytes_of<std::uint16_t>(0x0201)).find("version 2.1"), std::string::npos);
  EXPECT_NE(error(header()).find("has 0 records"), std::string::npos);
  EXPECT_NE(error(header() + start(1, "/arm/speed", "double") + record(1, 1, real(1))).find("\"/arm/speed of double\""),
            std::string::npos);
  EXPECT_NE(error(header() + long_record(0, 0, std::string("\0\1", 2))).find("damaged control record"),
            std::string::npos);
  std::string many = header();
  for (unsigned i = 1; i <= 65'537; ++i) many += start(i, "", "");
  EXPECT_NE(error(many).find("more than 65536 entries"), std::string::npos);
  TakeSettings blind;
  EXPECT_NE(import_wpilog(header() + drive() + start(2, kPhotonName, kPhotonType) + long_record(2, 10.08, photon({{}})),
                          "run.wpilog", {}, blind)
                .error()
                .message()
                .find("--camera"),
            std::string::npos);
}

TEST(ImportWpilog, ReadsAFileThatWasCutOffAtAnyByte) {
  const std::string whole = header() + drive() + start(2, kPhotonName, kPhotonType) +
                            long_record(2, 10.08, photon({{.kind = 3, .smallest = corners({100, 200, 120, 240})}}));
  for (std::size_t size = header().size(); size < whole.size(); ++size) {
    const ImportResult result = import_wpilog(whole.substr(0, size), "run.wpilog", {}, settings(640, 480, 500));
    EXPECT_TRUE(!result.ok() || result->summary.frames == 0U);
  }
}

// Any bytes are read, or refused with a sentence.
TEST(ImportWpilog, NothingBreaksIt) {
  const std::string whole =
      header() + drive() + start(2, kPhotonName, kPhotonType) +
      long_record(2, 10.08, photon({{.kind = 3, .smallest = corners({100, 200, 120, 240})}, {.tag = 1}}, 20, true)) +
      start(3, kLimelight + "rawdetections", "double[]") +
      record(3, 10.08, reals({2, 5, 1, 0.4, 10, 20, 30, 20, 30, 40, 10, 40})) +
      start(4, kLimelight + "json", "string") + long_record(4, 10, R"({"Detector":[{"pts":[[1,2],[3,4]]}]})");
  std::mt19937 dice(1);
  int read = 0;
  for (int i = 0; i < 20'000; ++i) {
    std::string bytes = whole;
    for (auto changes = 1 + dice() % 6; changes > 0; --changes) {
      bytes[8 + dice() % (bytes.size() - 8)] = static_cast<char>(dice() % 4 == 0 ? 0xFF : dice());
    }
    const std::string entry =
        std::array<std::string, 4>{"", kPhotonName, kLimelight + "rawdetections", kLimelight + "json"}[dice() % 4];
    const ImportResult result = import_wpilog(bytes, "run.wpilog", {entry, ""}, settings(640, 480, 500));
    read += result.ok() ? 1 : 0;
    EXPECT_TRUE(result.ok() || !result.error().remedy.empty());
  }
  EXPECT_GT(read, 2'000);
}

}  // namespace
}  // namespace fencepost::host::wpilog
