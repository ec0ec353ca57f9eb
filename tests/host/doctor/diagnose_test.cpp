// Each finding about a log, provoked by one fault that was planted in a healthy drive.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "host/doctor/log/text.hpp"
#include "tests/host/cli/run.hpp"
#include "tests/host/doctor/drive.hpp"

namespace fencepost::host {
namespace {

using namespace testing;
using Codes = std::vector<std::string>;

Codes codes(const Drive& drive) { return codes_of(findings_of(drive.stream())); }

bool contains(const Codes& codes, const std::string& code) { return std::ranges::find(codes, code) != codes.end(); }

std::string camera_with(int field, const std::string& value) {
  std::string text = Drive().camera;
  std::size_t at = 0;
  for (int i = 0; i < field; ++i) at = text.find(',', at) + 1;
  return text.replace(at, text.find(',', at) - at, value);
}

TEST(DoctorLog, FindsNothingInAHealthyDrive) { EXPECT_EQ(codes(Drive()), Codes{}); }

TEST(DoctorLog, FindsNothingInTheBundledRecordings) {
  for (const char* name : {"approach_stop", "stop_pixy2", "stop_nxtcam", "blocks_arc", "noisy_arc", "corridor"}) {
    const std::string log = testing::slurp(std::string(FENCEPOST_SOURCE_DIR "/host/share/recordings/") + name + ".log");
    ASSERT_FALSE(log.empty());
    EXPECT_EQ(codes_of(findings_of(log)), Codes{}) << name;
  }
}

TEST(DoctorLog, SaysThatATextIsNoLog) {
  EXPECT_EQ(codes_of(findings_of("hello\nworld\n")), Codes{"no_records"});
  EXPECT_EQ(codes_of(findings_of("")), Codes{"no_records"});
}

TEST(DoctorLog, CountsChecksumLossesWithTheirFirstLine) {
  std::string log = Drive().stream();
  const std::size_t at = log.find("FPODO,1.0000");
  ++log[at + 15];
  const doctor::Findings findings = findings_of(log);
  ASSERT_EQ(codes_of(findings), Codes{"crc"});
  EXPECT_EQ(findings[0].severity, doctor::Severity::kFault);
  const auto line = 1 + std::count(log.begin(), log.begin() + static_cast<std::ptrdiff_t>(at), '\n');
  EXPECT_NE(findings[0].what.find("1 line rejected (crc)"), std::string::npos) << findings[0].what;
  EXPECT_TRUE(findings[0].what.ends_with("first in line " + std::to_string(line))) << findings[0].what;
}

TEST(DoctorLog, NamesEachReasonOfALineThatIsWrong) {
  EXPECT_TRUE(contains(codes({.more = {"FPXYZ,1"}}), "kind"));
  EXPECT_TRUE(contains(codes({.more = {"FPODO,1.0"}}), "fields"));
  EXPECT_TRUE(contains(codes({.more = {"FPODO,x,0.0,0.0,0.0"}}), "number"));
  EXPECT_TRUE(contains(codes({.more = {"FPODO,1.0,9999.0,0.0,0.0"}}), "range"));
  EXPECT_TRUE(contains(codes({.more = {"FPODO,0.0100,0.0000,0.0000,0.0000"}}), "time"));
  EXPECT_TRUE(contains(codes_of(findings_of(Drive().stream() + "$FPODO,1.0")), "truncated"));
}

TEST(DoctorLog, SaysThatMuchOfItIsForeign) {
  std::string log = Drive().stream();
  for (int i = 0; i < 100; ++i) log += "debug\n";
  EXPECT_EQ(codes_of(findings_of(log)), Codes{"foreign"});
}

TEST(DoctorLog, MissesASensor) {
  EXPECT_TRUE(contains(codes({.odometry_there = [](double) { return false; }}), "no_odometry"));
  EXPECT_TRUE(contains(codes({.frame_there = [](int) { return false; }}), "no_frames"));
}

TEST(DoctorLog, FindsGapsAndWhatTheyCost) {
  const Drive camera{.frame_there = [](int i) { return i < 40 || i > 60; }};
  EXPECT_EQ(codes(camera), (Codes{"camera_gaps", "frames_missing"}));
  const Drive odometry{.odometry_there = [](double t) { return t < 2 || t > 3; }};
  EXPECT_EQ(codes(odometry), (Codes{"odometry_gaps", "refused_no_pose", "refused_odometry_gap"}));
}

TEST(DoctorLog, FindsSlowSensors) {
  const Drive camera{.frames = 200, .frame_there = [](int i) { return i % 10 == 0; }};
  EXPECT_TRUE(contains(codes(camera), "slow_camera"));
  const Drive odometry{.frames = 200, .odometry_there = [](double t) { return std::lround(t / 0.025) % 8 == 0; }};
  EXPECT_TRUE(contains(codes(odometry), "slow_odometry"));
}

TEST(DoctorLog, FindsTwoClocks) {
  EXPECT_TRUE(contains(codes({.odometry_clock = 30}), "clock_offset"));
  const Drive drifting{.frames = 400, .frame_clock = [](double t) { return 1.02 * t; }};
  EXPECT_TRUE(contains(codes(drifting), "clock_drift"));
  const Drive steady{.frames = 400, .frame_clock = [](double t) { return 1.001 * t; }};
  EXPECT_FALSE(contains(codes(steady), "clock_drift"));
}

TEST(DoctorLog, FindsSeveralRuns) {
  EXPECT_EQ(codes_of(findings_of(Drive().stream() + Drive().stream())), Codes{"runs"});
}

TEST(DoctorLog, FindsAPoseThatJumps) {
  EXPECT_TRUE(contains(codes({.odometry_x = [](double x) { return x > 0.3 ? x + 1 : x; }}), "odometry_jumps"));
}

TEST(DoctorLog, FindsOdometryThatNeverMoves) { EXPECT_EQ(codes({.frames = 120, .speed = 0}), Codes{"odometry_still"}); }

TEST(DoctorLog, FindsAMissingOrImplausibleCalibration) {
  EXPECT_TRUE(contains(codes({.camera = ""}), "no_calibration"));
  EXPECT_TRUE(contains(codes({.camera = ""}), "refused_no_camera"));
  struct Planted {
    int field;
    const char* value;
    const char* code;
  };
  for (const Planted& planted : {Planted{4, "9000.00", "calibration_field_of_view"},
                                 {4, "30.00", "calibration_field_of_view"},
                                 {5, "150.00", "calibration_oblong"},
                                 {6, "20.00", "calibration_centre"},
                                 {11, "0.0000", "calibration_height"},
                                 {11, "120.0000", "calibration_height"},
                                 {13, "", "calibration_pitch_unknown"},
                                 {13, "1.2000", "calibration_pitch"},
                                 {14, "0.9000", "calibration_latency"}}) {
    EXPECT_TRUE(contains(codes({.camera = camera_with(planted.field, planted.value)}), planted.code))
        << planted.code << " " << planted.value;
  }
}

TEST(DoctorLog, ComparesACameraWithWhatItsMakerSays) {
  sensor::CameraIntrinsics maker;
  maker.model = "test";
  maker.width = 316;
  maker.height = 208;
  maker.fx = base::Pixels2::nearest(273.7);
  maker.fy = maker.fx;
  EXPECT_EQ(codes_of(findings_of(Drive().stream(), {maker})), Codes{});
  maker.fx = base::Pixels2::nearest(188);
  EXPECT_EQ(codes_of(findings_of(Drive().stream(), {maker})), Codes{"calibration_lens"});
  maker.fx = base::Pixels2::nearest(273.7 * 320 / 316);
  maker.width = 320;
  EXPECT_EQ(codes_of(findings_of(Drive().stream(), {maker})), Codes{"calibration_size"});
}

TEST(DoctorLog, FindsACalibrationThatChangedOnTheWay) {
  EXPECT_EQ(codes({.more = {camera_with(11, "0.1300")}}), Codes{"calibration_changed"});
  EXPECT_EQ(codes({.more = {Drive().camera}}), Codes{}) << "it is only repeated";
}

TEST(DoctorLog, HandsOnWhatTheRobotItselfDoubts) {
  // The recording of an approach, with a camera that is said to look 6 degrees farther down than it does.
  std::string log = testing::slurp(FENCEPOST_SOURCE_DIR "/host/share/recordings/corridor.log");
  const std::size_t begin = log.find("$FPCAM");
  const std::string line = log.substr(begin, log.find('\n', begin) + 1 - begin);
  std::string fields = line.substr(1, line.find('*') - 1);
  const std::size_t latency = fields.rfind(',');
  const std::size_t pitch = fields.rfind(',', latency - 1);
  fields.replace(pitch + 1, latency - pitch - 1, "0.1000");
  for (std::size_t at = 0; (at = log.find(line, at)) != std::string::npos; ++at) {
    log.replace(at, line.size(), line_of(fields));
  }
  const Codes found = codes_of(findings_of(log));
  EXPECT_TRUE(contains(found, "calibration_rows")) << ::testing::PrintToString(found);
  // The reason takes the place of the robot's doubt.
  const doctor::Finding reason{doctor::Severity::kWarning, "distance_pitch", "the pitch", ""};
  const Codes with_reason = codes_of(doctor::diagnose(doctor::survey_log(log, "test.log"), {}, {reason}));
  EXPECT_FALSE(contains(with_reason, "calibration_rows")) << ::testing::PrintToString(with_reason);
  EXPECT_TRUE(contains(with_reason, "distance_pitch"));
}

TEST(DoctorLog, MeasuresAColourThatFlickers) {
  const Drive drive{.seen = [](int i) { return i % 5 != 0; }};
  EXPECT_EQ(codes(drive), Codes{"colour_flicker"});
  const doctor::LogSurvey survey = doctor::survey_log(drive.stream(), "test.log");
  ASSERT_EQ(survey.colours.size(), 1U);
  EXPECT_NEAR(survey.colours[0].seen, 79 / 98.0, 1e-9);
  EXPECT_NEAR(survey.colours[0].flicker, 100 * 19 / 79.0, 1e-9);
  EXPECT_EQ(survey.colours[0].blobs, 1);
}

TEST(DoctorLog, MeasuresASizeThatJumpsAndNotOneThatGrows) {
  EXPECT_EQ(codes({.width = [](int i) { return 20 + i; }}), Codes{}) << "an approach";
  // Steps of +-8 px: every second difference is 16 or 32 px.
  EXPECT_EQ(codes({.width = [](int i) { return i % 2 == 0 ? 30 : 46; }}), Codes{"colour_jitter"});
}

TEST(DoctorLog, FindsColoursThatNobodyNamedOrSaw) {
  EXPECT_EQ(codes({.more = {"FPSIG,2,20d020,green"}}), Codes{});
  EXPECT_EQ(codes({.named = false, .more = {"FPSIG,2,20d020,green"}}), Codes{"colour_unnamed"});
  EXPECT_TRUE(contains(codes({.seen = [](int) { return false; }}), "nothing_seen"));
}

TEST(DoctorLog, FindsWhatTheRobotReported) {
  const Drive drive{.more = {"FPSTA,2.0000,10,10,0,10,0,0,0,1,100", "FPSTA,2.1000,20,20,3,20,2,0,7,1,100",
                             "FPLNK,2.1000,pixy2,silent,/dev/ttyUSB0", "FPLNK,2.4000,pixy2,ok,/dev/ttyUSB0",
                             "FPALV,2.1000,blind,silent,ok", "FPALV,2.4000,clear,ok,ok"}};
  EXPECT_EQ(codes(drive), (Codes{"records_dropped", "blobs_dropped", "robot_rejected", "link_silent", "blind"}));
}

TEST(DoctorLog, WritesTheSameAsADocument) {
  const doctor::LogSurvey survey = doctor::survey_log(Drive().stream(), "test\x1b.log");
  const nlohmann::ordered_json document = doctor::survey_json(survey);
  EXPECT_EQ(document["log"], "test?.log");
  EXPECT_EQ(document["camera"]["records"], 98);
  EXPECT_NEAR(document["camera"]["rate"].get<double>(), 20, 1e-6);
  EXPECT_EQ(document["colours"][0]["name"], "red");
  const std::string text = doctor::survey_text(survey);
  EXPECT_NE(text.find("98 records, 20.0 a second, longest gap 0.05 s\n"), std::string::npos) << text;
}

}  // namespace
}  // namespace fencepost::host
