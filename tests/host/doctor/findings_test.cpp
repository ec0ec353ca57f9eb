// Every finding that there can be, provoked: one that is not in this table fails it.
#include "host/doctor/finding.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <fstream>
#include <functional>
#include <map>
#include <sstream>

#include "host/calibrate/cause_findings.hpp"
#include "tests/firmware/level_pixy2.hpp"
#include "tests/firmware/recon/post_world.hpp"
#include "tests/firmware/record/lines.hpp"
#include "tests/folder.hpp"
#include "tests/hal/linux/pty.hpp"
#include "tests/host/cli/run.hpp"
#include "tests/host/doctor/drive.hpp"
#include "tests/host/doctor/fake_pixy2.hpp"

namespace fencepost::host {
namespace {

using doctor::Findings;
using namespace testing;
using Provoke = std::function<Findings()>;

Findings of(const Drive& drive) { return testing::findings_of(drive.stream()); }

/// A healthy drive with this line in its middle.
Findings with(const std::string& fields) { return of({.more = {fields}}); }

/// With one field of $FPCAM changed; the lens as given is its maker's.
Findings camera(int field, const std::string& value, bool known = false) {
  Drive drive;
  std::size_t at = 0;
  for (int i = 0; i < field; ++i) at = drive.camera.find(',', at) + 1;
  const std::string whole = drive.camera;
  drive.camera.replace(at, drive.camera.find(',', at) - at, value);
  sensor::CameraIntrinsics maker;
  maker.model = "test";
  maker.width = 316;
  maker.height = 208;
  maker.fx = maker.fy = base::Pixels2::nearest(273.7);
  return testing::findings_of(drive.stream(), known ? std::vector{maker} : std::vector<sensor::CameraIntrinsics>{});
}

/// A recording whose calibration has one value more and less wrong, everywhere.
Findings doubted(const char* recording, int field, const std::string& value) {
  std::string log = testing::slurp(std::string(FENCEPOST_SOURCE_DIR "/host/share/recordings/") + recording);
  const std::size_t begin = log.find("$FPCAM");
  const std::string line = log.substr(begin, log.find('\n', begin) + 1 - begin);
  std::string fields = line.substr(1, line.find('*') - 1);
  std::size_t from = 0;
  for (int i = 0; i < field; ++i) from = fields.find(',', from) + 1;
  fields.replace(from, fields.find(',', from) - from, value);
  for (std::size_t at = 0; (at = log.find(line, at)) != std::string::npos; ++at) {
    log.replace(at, line.size(), line_of(fields));
  }
  return testing::findings_of(log);
}

/// Three posts, seen by a lens that is wider than configured, while the robot turns to and fro before them.
Findings wrong_lens() {
  const std::vector<test::RoundPost> posts = {{1, 1.2, 0.18, 0.04}, {2, 1.15, 0.0, 0.04}, {3, 1.2, -0.18, 0.04}};
  std::string log = line_of("FPHDR,1,fencepost,0.1.0,test,full") + test::line_of(test::level_pixy2(0));
  for (std::uint32_t i = 0; i < 300; ++i) {
    const base::Time t{500 * static_cast<std::int64_t>(i)};
    const double heading = 0.25 * std::sin(0.05 * i);
    log += test::line_of(sensor::OdometrySample{t, {}, {}, base::Radians::nearest(heading)});
    log += test::line_of(test::view_of_posts(posts, {.focal = 200}, 0, 0, heading, t.raw, i));
  }
  return testing::findings_of(log);
}

Findings link(const std::string& state) {
  return of({.more = {"FPLNK,2.1000,pixy2," + state + ",/dev/ttyUSB0", "FPLNK,2.4000,pixy2,ok,/dev/ttyUSB0"}});
}

Findings of_port(FakePixy2::Mood mood, std::uint32_t baud = 0) {
  const test::Folder folder;
  const FakePixy2 pixy(folder.file("port"), mood, baud);
  return examined("pixy2:" + folder.file("port"));
}

Findings of_whatever_is_there() {
  const test::Folder folder;
  const FakePixy2 pixy(folder.file("port"), FakePixy2::Mood::kSeesOne);
  return doctor::examine_port(folder.file("port"), {}, doctor::Identity::own(), testing::kQuick, [] { return false; });
}

Findings of_empty_port(const std::function<Findings(const std::string&)>& look) {
  const test::Folder folder;
  const linux::FarEnd far(folder.file("port"));
  return look(folder.file("port"));
}

Findings busy(const std::string& port) {
  const linux::Descriptor other(::open(port.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC));
  EXPECT_EQ(::flock(other.get(), LOCK_EX), 0);
  return examined("pixy2:" + port);
}

Findings forbidden(const std::string& port) {
  struct stat about {};
  EXPECT_EQ(::stat(port.c_str(), &about), 0);
  return examined("pixy2:" + port, {about.st_uid + 1, "ann", {}, {}});
}

Findings no_terminal() {
  const test::Folder folder;
  std::ofstream(folder.file("text")) << "no port\n";
  return examined("pixy2:" + folder.file("text"));
}

Findings crc() {
  std::string log = Drive().stream();
  ++log[log.find("FPODO,1.0000") + 15];
  return testing::findings_of(log);
}

/// A healthy drive, in which every frame has the colour in five pieces.
Findings pieces() {
  std::string blobs = ",5";
  for (int i = 0; i < 5; ++i) blobs += fmt::format(",1,{},80,{},120,{}.0,100.0,0,", 20 * i, 20 * i + 9, 20 * i + 5);
  std::string log;
  std::istringstream lines(Drive().stream());
  for (std::string line; std::getline(lines, line);) {
    const std::string stamp = line.substr(0, line.find(',', line.find(',', 7) + 1));  // "$FPFRM,2.5200,50"
    log += line.starts_with("$FPFRM") ? line_of(stamp.substr(1) + blobs) : line + "\n";
  }
  return testing::findings_of(log);
}

/// It counts since its start: only the second report tells what was lost in the log's time.
Findings reported(const std::string& status) { return of({.more = {"FPSTA,2.0,10,10,0,10,0,0,0,1,100", status}}); }

std::map<std::string, Provoke> ports() {
  using enum FakePixy2::Mood;
  return {{"no_port", [] { return examined("pixy2:/dev/no_such_port"); }},
          {"no_permission", [] { return of_empty_port(forbidden); }},
          {"busy", [] { return of_empty_port(busy); }},
          {"answers", of_whatever_is_there},
          {"cannot_open", no_terminal},
          {"wrong_baud", [] { return of_port(kSeesOne, 57'600); }},
          {"silent", [] { return of_empty_port([](const std::string& port) { return examined("pixy2:" + port); }); }},
          {"unready", [] { return of_port(kBusy); }},
          {"nothing_seen", [] { return of_port(kSeesNothing); }},
          {"fine", [] { return of_port(kSeesOne); }}};
}

std::map<std::string, Provoke> lines() {
  return {{"no_records", [] { return testing::findings_of("hello\n"); }},
          {"crc", crc},
          {"kind", [] { return with("FPXYZ,1"); }},
          {"fields", [] { return with("FPODO,1.0"); }},
          {"number", [] { return with("FPODO,x,0.0,0.0,0.0"); }},
          {"range", [] { return with("FPODO,1.0,9999.0,0.0,0.0"); }},
          {"length", [] { return with("FPODO," + std::string(3'000, '1')); }},
          {"truncated", [] { return testing::findings_of(Drive().stream() + "$FPODO,1.0"); }},
          {"time", [] { return with("FPODO,0.0100,0.0000,0.0000,0.0000"); }},
          {"format", [] { return with("FPHDR,2,fencepost,9.0.0,test,full"); }},
          {"foreign", [] {
             std::string log = Drive().stream();
             for (int i = 0; i < 100; ++i) log += "debug\n";
             return testing::findings_of(log);
           }}};
}

std::map<std::string, Provoke> course() {
  const auto never = [](int) { return false; };
  return {
      {"no_frames", [=] { return of({.frame_there = never}); }},
      {"no_odometry", [] { return of({.odometry_there = [](double) { return false; }}); }},
      {"slow_camera", [] { return of({.frames = 200, .frame_there = [](int i) { return i % 10 == 0; }}); }},
      {"slow_odometry",
       [] { return of({.frames = 200, .odometry_there = [](double t) { return std::lround(t / 0.025) % 8 == 0; }}); }},
      {"camera_gaps", [] { return of({.frame_there = [](int i) { return i < 40 || i > 60; }}); }},
      {"frames_missing", [] { return of({.frame_there = [](int i) { return i < 40 || i > 60; }}); }},
      {"odometry_gaps", [] { return of({.odometry_there = [](double t) { return t < 2 || t > 3; }}); }},
      {"refused_odometry_gap", [] { return of({.odometry_there = [](double t) { return t < 2 || t > 3; }}); }},
      {"no_usable_frame", [] { return of({.camera = ""}); }},
      {"refused_no_camera", [] { return of({.camera = ""}); }},
      {"refused_no_pose", [] { return of({.odometry_there = [](double t) { return t < 2 || t > 3; }}); }},
      {"refused_queue", [] { return reported("FPSTA,2.1,20,20,0,20,0,9,0,1,100"); }},
      {"runs", [] { return testing::findings_of(Drive().stream() + Drive().stream()); }},
      {"clock_offset", [] { return of({.odometry_clock = 30}); }},
      {"clock_drift", [] { return of({.frames = 400, .frame_clock = [](double t) { return 1.02 * t; }}); }},
      {"odometry_jumps", [] { return of({.odometry_x = [](double x) { return x > 0.3 ? x + 1 : x; }}); }},
      {"odometry_still", [] { return of({.frames = 120, .speed = 0}); }}};
}

std::map<std::string, Provoke> calibration() {
  return {{"no_calibration", [] { return of({.camera = ""}); }},
          {"calibration_field_of_view", [] { return camera(4, "9000.00"); }},
          {"calibration_oblong", [] { return camera(5, "150.00"); }},
          {"calibration_centre", [] { return camera(6, "20.00"); }},
          {"calibration_height", [] { return camera(11, "0.0000"); }},
          {"calibration_pitch_unknown", [] { return camera(13, ""); }},
          {"calibration_pitch", [] { return camera(13, "1.2000"); }},
          {"calibration_latency", [] { return camera(14, "0.9000"); }},
          {"calibration_size", [] { return camera(2, "400", true); }},
          {"calibration_lens", [] { return camera(4, "188.00", true); }},
          {"calibration_changed",
           [] {
             std::string changed = Drive().camera;
             return with(changed.replace(changed.find("0.1200"), 6, "0.1300"));
           }},
          {"calibration_rows", [] { return doubted("corridor.log", 13, "0.1000"); }},
          {"calibration_focal_length", [] { return wrong_lens(); }}};
}

/// The finding of a cause. Which causes a log has is tested in tests/host/calibrate/command.
Provoke caused(CauseKind kind) {
  return [kind] { return findings_of_causes({{.kind = kind, .signature = 1, .found = 1, .sigma = 0.1}}, {}, "a.log"); };
}

std::map<std::string, Provoke> distances() {
  using enum CauseKind;
  return {{"distance_pad", caused(kPad)},
          {"distance_width", caused(kWidth)},
          {"distance_focal_length", caused(kFocal)},
          {"distance_pitch", caused(kPitch)},
          {"distance_yaw", caused(kYaw)},
          {"distance_height", caused(kHeight)},
          {"distance_latency", caused(kLatency)},
          {"distance_ways", caused(kStep)},
          {"distance_turns", caused(kTurn)},
          {"distance_curve", caused(kCurve)}};
}

std::map<std::string, Provoke> colours_and_links() {
  return {{"colour_unnamed", [] { return of({.named = false, .more = {"FPSIG,2,20d020,green"}}); }},
          {"colour_flicker", [] { return of({.seen = [](int i) { return i % 5 != 0; }}); }},
          {"colour_jitter", [] { return of({.width = [](int i) { return i % 2 == 0 ? 30 : 46; }}); }},
          {"colour_pieces", pieces},
          {"records_dropped", [] { return reported("FPSTA,2.1,20,20,0,20,0,0,3,1,100"); }},
          {"blobs_dropped", [] { return reported("FPSTA,2.1,20,20,2,20,0,0,0,1,100"); }},
          {"robot_rejected", [] { return reported("FPSTA,2.1,20,20,0,20,7,0,0,1,100"); }},
          {"link_absent", [] { return link("absent"); }},
          {"link_silent", [] { return link("silent"); }},
          {"link_unready", [] { return link("unready"); }},
          {"blind", [] {
             return of({.more = {"FPALV,2.1,blind,silent,ok", "FPALV,2.4,clear,ok,ok"}});
           }}};
}

std::map<std::string, Provoke> all() {
  std::map<std::string, Provoke> every;
  for (auto& some : {ports(), lines(), course(), calibration(), distances(), colours_and_links()}) {
    for (const auto& [code, provoke] : some) EXPECT_TRUE(every.emplace(code, provoke).second) << code;
  }
  return every;
}

/// Codes that are in one and not in the other.
std::vector<std::string> unprovoked(const std::map<std::string, Provoke>& provoked) {
  std::vector<std::string> missing;
  for (const std::string_view code : doctor::kCodes) {
    if (!provoked.contains(std::string(code))) missing.emplace_back(code);
  }
  return missing;
}

TEST(DoctorFindings, HaveEachAProvocation) {
  std::map<std::string, Provoke> every = all();
  EXPECT_EQ(unprovoked(every), std::vector<std::string>{});
  EXPECT_EQ(every.size(), std::size(doctor::kCodes));
  every.erase("colour_pieces");
  EXPECT_EQ(unprovoked(every), std::vector<std::string>{"colour_pieces"}) << "and a code without one is named";
}

TEST(DoctorFindings, ComeWhereTheyAreProvoked) {
  for (const auto& [code, provoke] : all()) {
    const std::vector<std::string> found = testing::codes_of(provoke());
    EXPECT_TRUE(std::ranges::find(found, code) != found.end()) << code << ": " << ::testing::PrintToString(found);
  }
}

TEST(DoctorFindings, APadIsAddedToWhatTheRobotTakesOff) {
  const Cause pad{.kind = CauseKind::kPad, .signature = 1, .found = 2.34, .sigma = 0.1};
  const std::vector<record::Signature> known = {{1, {0xd0, 0x20, 0x20}, "red", 2, 64}, {2, {}, "blue"}};
  const Findings findings = findings_of_causes({pad}, known, "a.log");
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_TRUE(findings[0].remedy.ends_with(" $FPSIG,1,d02020,red,0.064,4")) << findings[0].remedy;
}

TEST(DoctorFindings, AreNoneInAHealthyDrive) { EXPECT_EQ(testing::codes_of(of({})), std::vector<std::string>{}); }

TEST(DoctorFindings, AreInTheDocument) {
  const std::string document = testing::slurp(FENCEPOST_SOURCE_DIR "/host/share/doc/doctor.md");
  for (const std::string_view code : doctor::kCodes) {
    const std::string word(code);
    const bool short_form =
        word.starts_with("calibration_") &&
        document.find("`" + word.substr(std::string("calibration").size()) + "`") != std::string::npos;
    const bool family = word.starts_with("refused_") && document.find("`refused_*`") != std::string::npos;
    EXPECT_TRUE(short_form || family || document.find("`" + word + "`") != std::string::npos) << word;
  }
}

TEST(DoctorFindings, HaveNoOtherNames) {
  EXPECT_EQ(doctor::Code::of("crc"), "crc");
  EXPECT_THROW(static_cast<void>(doctor::Code::of("crcs")), std::logic_error);
}

}  // namespace
}  // namespace fencepost::host
