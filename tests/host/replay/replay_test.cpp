#include "host/replay/replay.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <sstream>

#include "firmware/record/encode.hpp"
#include "hal/base/crc16.hpp"
#include "host/geometry/planar.hpp"
#include "host/geometry/rings.hpp"
#include "host/scene/load.hpp"
#include "tests/host/contents.hpp"

namespace fencepost::test {
namespace {

using host::replay;
using host::ReplayOptions;
using host::ReplayOutcome;

const std::string kRecordings = FENCEPOST_SOURCE_DIR "/host/share/recordings/";
constexpr const char* kNames[] = {"approach_stop", "blocks_arc", "corridor", "noisy_arc"};

double distance_to(const host::LinearRing& ring, const host::GuardPoint& point) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const host::Point& a = ring[i];
    const host::Point& b = ring[(i + 1) % ring.size()];
    const double dx = b.x - a.x;
    const double dy = b.y - a.y;
    const double along = ((point.x - a.x) * dx + (point.y - a.y) * dy) / (dx * dx + dy * dy);
    const double t = std::clamp(along, 0.0, 1.0);
    nearest = std::min(nearest, std::hypot(point.x - a.x - t * dx, point.y - a.y - t * dy));
  }
  return nearest;
}

ReplayOptions with(const std::string& profile) {
  ReplayOptions options;
  options.profile = profile;
  return options;
}

std::vector<std::string> lines_of(const std::string& log) {
  std::vector<std::string> lines;
  std::istringstream stream(log);
  for (std::string line; std::getline(stream, line);) lines.push_back(line + "\n");
  return lines;
}
std::string joined(const std::vector<std::string>& lines) {
  std::string log;
  for (const std::string& line : lines) log += line;
  return log;
}
template <class Record>
std::string line_of(const Record& record) {
  std::array<char, record::kMaxLine> buffer{};
  return {buffer.data(), record::encode(record, buffer)};
}

const host::ModelResult* model(const host::ObjectResult& object, const std::string& name) {
  const auto found =
      std::find_if(object.models.begin(), object.models.end(), [&](const auto& m) { return m.name == name; });
  return found == object.models.end() ? nullptr : &*found;
}

TEST(Replay, EveryProfileReplaysItsOwnLogToTheSameDigestAndAlerts) {
  for (const char* name : kNames) {
    for (const char* profile : {"micro", "small", "full"}) {
      SCOPED_TRACE(std::string(name) + " " + profile);
      std::string own;
      ReplayOptions options = with(profile);
      options.log = [&](std::string_view line) { own += line; };
      const ReplayOutcome first = replay(bundled_log(name), name, options);
      ASSERT_FALSE(first.unreadable);
      ReplayOptions checking;
      checking.check = true;  // the profile is taken from the log's header
      const ReplayOutcome again = replay(own, "own log", checking);
      EXPECT_EQ(again.result.profile, profile);
      EXPECT_EQ(again.result.digest, first.result.digest);
      EXPECT_EQ(again.result.alerts, first.result.alerts);
      EXPECT_GT(again.check.compared, 20U);
      EXPECT_EQ(again.check.differing, 0U) << again.check.mismatches.at(0);
    }
  }
}

TEST(Replay, CheckFindsAChangedRecord) {
  std::string own;
  ReplayOptions options;
  options.log = [&](std::string_view line) { own += line; };
  const ReplayOutcome first = replay(bundled_log("blocks_arc"), "blocks_arc", options);
  std::vector<std::string> lines = lines_of(own);
  const auto digest = std::find_if(lines.begin(), lines.end(), [](const auto& l) { return l.starts_with("$FPDIG"); });
  ASSERT_NE(digest, lines.end());
  *digest = line_of(record::DigestReport{49, 1});
  ReplayOptions checking;
  checking.check = true;
  const ReplayOutcome again = replay(joined(lines), "changed", checking);
  EXPECT_EQ(again.check.differing, 1U);
  ASSERT_EQ(again.check.mismatches.size(), 1U);
  EXPECT_NE(again.check.mismatches[0].find("line " + std::to_string(digest - lines.begin() + 1)), std::string::npos)
      << again.check.mismatches[0];
}

// A recorder asks for `mode log` and `reset`: what a robot says between the two is of a run that it alone knows.
TEST(Replay, CheckComparesNothingBeforeTheFirstHeaderWhereOneFollows) {
  std::string own;
  ReplayOptions options;
  options.log = [&](std::string_view line) { own += line; };
  replay(bundled_log("blocks_arc"), "blocks_arc", options);
  std::vector<std::string> lines = lines_of(own);
  ASSERT_TRUE(lines[0].starts_with("$FPHDR"));
  const std::string late =
      joined(std::vector<std::string>(lines.begin() + static_cast<std::ptrdiff_t>(lines.size() / 2), lines.end()));
  ReplayOptions checking;
  checking.check = true;
  EXPECT_GT(replay(late, "late", checking).check.differing, 0U);

  const host::CheckOutcome check = replay(late + own, "late and whole", checking).check;
  EXPECT_EQ(check.differing, 0U);
  EXPECT_EQ(check.compared, replay(own, "whole", checking).check.compared);

  *std::find_if(lines.begin(), lines.end(), [](const auto& l) { return l.starts_with("$FPDIG"); }) =
      line_of(record::DigestReport{49, 1});
  EXPECT_EQ(replay(late + joined(lines), "late and changed", checking).check.differing, 1U);
}

TEST(Replay, TheApproachEndsInAStopForTheRightObject) {
  std::vector<std::string> sentences;
  ReplayOptions options;
  options.text = [&](std::string_view line) { sentences.emplace_back(line); };
  const ReplayOutcome outcome = replay(bundled_log("approach_stop"), "approach_stop", options);
  ASSERT_FALSE(outcome.result.alerts.empty());
  EXPECT_EQ(outcome.result.alerts.back().level, record::AlertLevel::kStop);
  EXPECT_EQ(outcome.result.alerts.back().signature, 1);
  EXPECT_EQ(sentences.size(), outcome.result.alerts.size());
  EXPECT_TRUE(sentences.back().starts_with("STOP    red  0.")) << sentences.back();
  for (std::size_t i = 1; i < outcome.result.alerts.size(); ++i) {
    EXPECT_GE(outcome.result.alerts[i].t, outcome.result.alerts[i - 1].t);
  }
}

TEST(Replay, TheGuardKnowsTheFeetOfWhatTheRobotDroveAt) {
  const ReplayOutcome outcome = replay(bundled_log("approach_stop"), "approach_stop", {});
  const host::LoadedScene scene = host::load_scene(kRecordings + "approach_stop.json");
  ASSERT_TRUE(scene.ok());
  int of_the_box = 0;
  for (const host::GuardPoint& point : outcome.result.guard) {
    SCOPED_TRACE(std::to_string(point.x) + " " + std::to_string(point.y));
    const auto seen = std::find_if(scene->objects.begin(), scene->objects.end(),
                                   [&](const auto& object) { return object.signature == point.signature; });
    ASSERT_NE(seen, scene->objects.end());
    EXPECT_LT(distance_to(seen->footprint.outer, point), 0.05);
    of_the_box += seen == scene->objects.begin() ? 1 : 0;
  }
  EXPECT_GE(of_the_box, 2);
}

TEST(Replay, TheBlocksWorldIsFound) {
  const ReplayOutcome outcome = replay(bundled_log("blocks_arc"), "blocks_arc", {});
  const host::LoadedScene scene = host::load_scene(kRecordings + "blocks_arc.json");
  ASSERT_TRUE(scene.ok());
  ASSERT_EQ(outcome.result.objects.size(), scene->objects.size());
  for (const host::SceneObject& truth : scene->objects) {
    SCOPED_TRACE(truth.name);
    const auto found = std::find_if(outcome.result.objects.begin(), outcome.result.objects.end(),
                                    [&](const auto& o) { return o.signature == truth.signature; });
    ASSERT_NE(found, outcome.result.objects.end());
    EXPECT_EQ(found->state, record::ObjectState::kConfirmed);
    EXPECT_EQ(found->views, 75U);
    EXPECT_NEAR(found->z_min, 0, 0.01);
    EXPECT_NEAR(found->z_max, truth.height_m, 0.01);
    const host::MultiPolygon footprint{truth.footprint};
    const host::MultiPolygon hull{host::convex_hull(footprint)};
    for (const char* name : {"clip", "carve"}) {
      SCOPED_TRACE(name);
      const host::ModelResult* m = model(*found, name);
      ASSERT_NE(m, nullptr);
      ASSERT_FALSE(m->geometry.empty());
      // Integer pixels at 1.2 m: 2 mm an edge. The footprint is enclosed but for that, and little else is.
      EXPECT_LT(host::difference_area(footprint, m->geometry) / host::area(footprint), 0.05);
      EXPECT_LT(host::difference_area(m->geometry, hull) / host::area(m->geometry), 0.15);
    }
    const host::ModelResult* cylinder = model(*found, "cylinder");
    ASSERT_TRUE(cylinder != nullptr && cylinder->circle.has_value());
    EXPECT_NEAR(host::area(cylinder->geometry), M_PI * cylinder->circle->radius * cylinder->circle->radius, 1e-9);
    EXPECT_EQ(cylinder->geometry[0].outer.size(), 64U);
  }
}

// Models that the robot does not run are computed beside its own.
TEST(Replay, SheafFindsTheBlocksOfEachProfile) {
  for (const char* profile : {"micro", "small", "full"}) {
    const ReplayOutcome outcome = replay(bundled_log("blocks_arc"), "blocks_arc", with(profile));
    ASSERT_FALSE(outcome.result.objects.empty());
    for (const host::ObjectResult& object : outcome.result.objects) {
      if (object.views < 40) continue;
      SCOPED_TRACE(std::string(profile) + " " + std::to_string(object.id));
      for (const char* name : {"sheaf", "sheaf_paper"}) {
        const host::ModelResult* sheaf = model(object, name);
        ASSERT_NE(sheaf, nullptr);
        ASSERT_EQ(sheaf->geometry.size(), 1U) << sheaf->reason;
        EXPECT_FALSE(host::find_invalidity(sheaf->geometry[0]).has_value());
        const host::MultiPolygon& clip = model(object, "clip")->geometry;
        EXPECT_GT(host::intersection_area(sheaf->geometry, clip), 0.8 * host::area(clip)) << name;
      }
    }
  }
}

TEST(Replay, FirstNFramesEqualALogCutThere) {
  const std::string log = bundled_log("blocks_arc");
  ReplayOptions options;
  options.frames = 30;
  const ReplayOutcome limited = replay(log, "limited", options);
  std::vector<std::string> lines = lines_of(log);
  int frames = 0;
  std::vector<std::string> cut;
  for (const std::string& line : lines) {
    cut.push_back(line);
    if (line.starts_with("$FPFRM") && ++frames == 30) break;
  }
  const ReplayOutcome whole = replay(joined(cut), "cut", {});
  EXPECT_EQ(limited.result.digest, whole.result.digest);
  EXPECT_EQ(limited.result.log.frames, 30U);
  EXPECT_EQ(limited.result.log.refused.no_pose, whole.result.log.refused.no_pose);
  EXPECT_EQ(limited.result.objects.size(), whole.result.objects.size());
}

TEST(Replay, FromAndToLimitTheStreamTime) {
  ReplayOptions options;
  options.from = 2.0;
  options.to = 4.0;
  const ReplayOutcome outcome = replay(bundled_log("blocks_arc"), "window", options);
  ASSERT_FALSE(outcome.unreadable);
  EXPECT_GE(outcome.result.path.front().t, 2.0);
  EXPECT_LE(outcome.result.path.back().t, 4.0);
  EXPECT_LT(outcome.result.objects[0].views, 40U);
}

// The robot's own assumption, given as an option, is the same run. Better poses: other weights, surer outlines.
TEST(Replay, PoseNoiseIsWhatItIsToldToBe) {
  const std::string log = bundled_log("blocks_arc");
  ReplayOptions options = with("full");
  const ReplayOutcome untold = replay(log, "x", options);
  options.pose_noise = host::PoseNoise{0.004, 0.007};
  EXPECT_EQ(replay(log, "x", options).result.digest, untold.result.digest);
  options.pose_noise = host::PoseNoise{0.001, 0.001};
  const ReplayOutcome better = replay(log, "x", options);
  EXPECT_NE(better.result.digest, untold.result.digest);
  ASSERT_EQ(better.result.objects.size(), untold.result.objects.size());
  ASSERT_FALSE(better.result.objects.empty());
  for (std::size_t i = 0; i < better.result.objects.size(); ++i) {
    EXPECT_GT(better.result.objects[i].confidence, untold.result.objects[i].confidence) << i;
  }
}

TEST(Replay, AHeaderStartsARunAfresh) {
  const std::string log = bundled_log("approach_stop");
  const ReplayOutcome once = replay(log, "once", {});
  const ReplayOutcome twice = replay(log + log, "twice", {});
  EXPECT_EQ(once.result.digest, twice.result.digest);
  EXPECT_EQ(once.result.alerts, twice.result.alerts);
  EXPECT_EQ(2 * once.result.log.frames, twice.result.log.frames);
}

TEST(Replay, RepeatedCalibrationHasNoEffect) {
  const std::string log = bundled_log("blocks_arc");
  const std::vector<std::string> lines = lines_of(log);
  std::string repeated;
  std::string calibration;
  int n = 0;
  for (const std::string& line : lines) {
    repeated += line;
    if (line.starts_with("$FPCAM") || line.starts_with("$FPSIG")) calibration += line;
    if (++n > 10 && n % 7 == 0) repeated += calibration;
  }
  EXPECT_EQ(replay(repeated, "repeated", {}).result.digest, replay(log, "log", {}).result.digest);
}

// --- bad input: said with place and remedy, and everything good is used ---

TEST(BadInput, GoodRecordsBeforeAndAfterABadOneAreUsed) {
  const std::string log = bundled_log("blocks_arc");
  const ReplayOutcome clean = replay(log, "clean", {});
  std::vector<std::string> lines = lines_of(log);
  const std::vector<std::string> bad = {"hello from the student's own program\r\n",
                                        "\r\n",
                                        "$FPODO,1,2,3\r\n",
                                        "$FPXYZ,1*0000\r\n",
                                        "$FPODO,12.3450,0.1234,-0.0010,1.5708*0df3\r\n",
                                        std::string("\0\xff\x80 garbage", 12) + "\n",
                                        "$FPFRM" + std::string(3000, 'x') + "\r\n"};
  for (std::size_t i = 0; i < bad.size(); ++i)
    lines.insert(lines.begin() + 20 + static_cast<std::ptrdiff_t>(10 * i), bad[i]);
  const ReplayOutcome dirty = replay(joined(lines), "dirty", {});
  EXPECT_EQ(dirty.result.digest, clean.result.digest);
  EXPECT_EQ(dirty.result.log.records, clean.result.log.records);
  EXPECT_EQ(dirty.result.log.foreign, 3U);
  std::uint64_t rejected = 0;
  for (const host::RejectedLines& reason : dirty.result.log.rejected) rejected += reason.count;
  EXPECT_EQ(rejected, 4U);
  EXPECT_EQ(dirty.result.log.rejected[static_cast<std::size_t>(record::Reject::kLength)].first_line, 81U);
}

TEST(BadInput, ATruncatedLogKeepsWhatItHas) {
  const std::string log = bundled_log("blocks_arc");
  const ReplayOutcome outcome = replay(std::string_view(log).substr(0, log.size() * 2 / 3), "truncated", {});
  ASSERT_FALSE(outcome.unreadable);
  EXPECT_EQ(outcome.result.log.rejected[static_cast<std::size_t>(record::Reject::kTruncated)].count, 1U);
  EXPECT_GT(outcome.result.objects.size(), 2U);
}

TEST(BadInput, TimeRunningBackwardsIsRejectedAndCounted) {
  std::vector<std::string> lines = lines_of(bundled_log("blocks_arc"));
  const std::uint64_t digest = replay(joined(lines), "clean", {}).result.digest;
  std::vector<std::string> odometry;
  for (const std::string& line : lines) {
    if (line.starts_with("$FPODO")) odometry.push_back(line);
  }
  for (int i = 0; i < 5; ++i) lines.insert(lines.end() - 10, odometry[static_cast<std::size_t>(i)]);
  const ReplayOutcome outcome = replay(joined(lines), "backwards", {});
  EXPECT_EQ(outcome.result.log.rejected[static_cast<std::size_t>(record::Reject::kTime)].count, 5U);
  EXPECT_EQ(outcome.result.digest, digest);
}

TEST(BadInput, MissingOdometryRefusesOnlyTheFramesInTheGap) {
  std::string log;
  for (const std::string& line : lines_of(bundled_log("blocks_arc"))) {
    double t = 0;
    if (std::sscanf(line.c_str(), "$FPODO,%lf", &t) == 1 && t > 2.0 && t < 4.0) continue;
    log += line;
  }
  const ReplayOutcome outcome = replay(log, "gap", {});
  ASSERT_FALSE(outcome.unreadable);
  const host::RefusedFrames& refused = outcome.result.log.refused;
  EXPECT_GT(refused.no_pose + refused.odometry_gap, 15U);
  EXPECT_LT(refused.no_pose + refused.odometry_gap, 25U);
  for (const host::ObjectResult& object : outcome.result.objects) EXPECT_GT(object.views, 45U);
}

TEST(BadInput, RandomBitFlipsNeverStopTheReader) {
  const std::string log = bundled_log("approach_stop");
  std::mt19937 random(11);
  for (int round = 0; round < 10; ++round) {
    std::string damaged = log;
    for (int flip = 0; flip < 40; ++flip) {
      // Not in the calibration at the top: without it frames are rightly refused until it is repeated.
      char& c = damaged[1000 + random() % (damaged.size() - 1000)];
      c = static_cast<char>(c ^ (1 << (random() % 8)));
    }
    const ReplayOutcome outcome = replay(damaged, "damaged", {});
    ASSERT_FALSE(outcome.unreadable);
    EXPECT_GT(outcome.result.log.records, lines_of(log).size() - 90);
  }
}

TEST(BadInput, UnreadableStreamsSayWhatAndWhatToTry) {
  const std::string camera_missing = [] {
    std::string log;
    for (const std::string& line : lines_of(bundled_log("blocks_arc"))) {
      if (!line.starts_with("$FPCAM")) log += line;
    }
    return log;
  }();
  std::string odometry_missing;
  for (const std::string& line : lines_of(bundled_log("blocks_arc"))) {
    if (!line.starts_with("$FPODO")) odometry_missing += line;
  }
  const std::pair<std::string, std::string> cases[] = {
      {"", "empty"},
      {"hello\nworld\n", "no record in 2 lines"},
      {"$FPHDR,2,fencepost,9.0.0,host,full*", "no record"},
      {line_of(record::Header{1, "fencepost", "0.1.0", "host", "full"}), "no frame record"},
      {camera_missing, "--camera"},
      {odometry_missing, "no odometry"}};
  for (const auto& [log, expected] : cases) {
    const ReplayOutcome outcome = replay(log, "file.log", {});
    ASSERT_TRUE(outcome.unreadable) << expected;
    EXPECT_NE(outcome.unreadable->message.find(expected), std::string::npos) << outcome.unreadable->message;
    EXPECT_EQ(outcome.unreadable->message.rfind("file.log", 0), 0U) << outcome.unreadable->message;
  }
}

TEST(BadInput, AnotherFormatEndsTheReading) {
  record::Header header{1, "fencepost", "9.0.0", "host", "full"};
  std::string line = line_of(header);
  // Format 2, with its own checksum.
  std::string body = "FPHDR,2,fencepost,9.0.0,host,full";
  char crc[8];
  std::snprintf(crc, sizeof crc, "%04X", base::crc16(body));
  const std::string other = "$" + body + "*" + crc + "\r\n";
  const ReplayOutcome outcome = replay(other + bundled_log("blocks_arc"), "future.log", {});
  ASSERT_TRUE(outcome.unreadable);
  EXPECT_NE(outcome.unreadable->message.find("future.log:1: stream format 2"), std::string::npos)
      << outcome.unreadable->message;
}

TEST(BadInput, AnUnknownProfileInTheHeaderIsSaid) {
  std::vector<std::string> lines = lines_of(bundled_log("blocks_arc"));
  lines[0] = line_of(record::Header{1, "fencepost", "0.1.0", "host", "giant"});
  const ReplayOutcome outcome = replay(joined(lines), "giant", {});
  ASSERT_EQ(outcome.complaints.size(), 1U);
  EXPECT_NE(outcome.complaints[0].find("giant"), std::string::npos);
  EXPECT_EQ(outcome.result.profile, "full");
}

TEST(BadInput, AnUnknownPitchIsSaidOnceHoweverOftenTheCalibrationComes) {
  sensor::CameraIntrinsics camera = host::load_scene(kRecordings + "corridor.json")->camera;
  camera.mount.pitch.reset();
  std::vector<std::string> lines = lines_of(bundled_log("corridor"));
  std::size_t calibrations = 0;
  for (std::string& line : lines) {
    if (!line.starts_with("$FPCAM")) continue;
    line = line_of(camera);
    ++calibrations;
  }
  ASSERT_GT(calibrations, 1U);
  const ReplayOutcome outcome = replay(joined(lines), "unknown", {});
  ASSERT_EQ(outcome.complaints.size(), 1U);
  EXPECT_NE(outcome.complaints[0].find("pitch unknown"), std::string::npos) << outcome.complaints[0];
  EXPECT_TRUE(replay(bundled_log("corridor"), "known", {}).complaints.empty());
}

}  // namespace
}  // namespace fencepost::test
