// Golden runs: the bundled recordings and random drives, through the whole loop of each profile. They have to end in
// the same state and to say the same lines as when golden_runs.csv was written. The digest of a state may change only
// where the changelog says so (firmware/recon/DIGEST.md), the lines only on purpose. FENCEPOST_GOLDEN=FOLDER writes
// golden_runs.csv anew there, and beside it all lines, to be compared.
#include <gtest/gtest.h>

#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>
#include <string_view>
#include <tuple>

#include "hal/base/fnv1a.hpp"
#include "tests/firmware/loop/desk.hpp"
#include "tests/firmware/loop/random_drive.hpp"

namespace fencepost::test {
namespace {

struct Run {
  const char* name;
  const char* recording;
  console::Mode mode;
  const char* first;             ///< typed before the recording
  unsigned harmed = 0;           ///< n: one byte of every n-th line is damaged; 0: of none
  unsigned lost = 0;             ///< n: every n-th line is not sent; 0: none
  const char* camera = nullptr;  ///< instead of the recording's
};
using console::Mode;
constexpr const char* kPitched =
    "FPCAM,pixy2.1,316,208,188.00,188.00,157.50,103.50,0.0000,0.1400,0.0000,0.1200,0.0000,0.3000,0.0500";
constexpr Run kRuns[] = {
    {"approach", "approach_stop", Mode::kLog, ""},
    {"approach in text", "approach_stop", Mode::kText, "alerts on\r"},
    {"approach plotted", "approach_stop", Mode::kPlot, ""},
    {"approach wide", "approach_stop", Mode::kText, "set robot.width 0.5\rset robot.front 0.3\rset robot.rear 0.1\r"},
    {"approach quick", "stop_pixy2", Mode::kLog, "set alert.rate 20\rset alert.ttc_warn 9\rset alert.warn 0.9\r"},
    {"cmucam2", "stop_cmucam2", Mode::kLog, ""},
    {"nxtcam", "stop_nxtcam", Mode::kText, "set confirm.k 1\rset confirm.n 4\r"},
    {"pixy2", "stop_pixy2", Mode::kText, ""},
    {"arc", "blocks_arc", Mode::kLog, ""},
    {"arc corrected", "blocks_arc", Mode::kText, "set correct.pose on\r"},
    {"arc uncorrected", "noisy_arc", Mode::kLog, "set correct.pose off\r"},
    {"noisy arc", "noisy_arc", Mode::kText, "calibrate\r"},
    {"noisy arc corrected", "noisy_arc", Mode::kLog,
     "set correct.pose on\rset correct.drift 10\rset camera.noise 1.5\r"},
    {"noisy arc with losses", "noisy_arc", Mode::kLog, "set correct.pose on\r", 13, 5},
    {"corridor", "corridor", Mode::kLog, "set correct.pose on\r"},
    {"corridor in text", "corridor", Mode::kText, "set robot.margin 0.3\r"},
    {"corridor with losses", "corridor", Mode::kText, "", 11, 7},
    {"corridor pitched", "corridor", Mode::kLog, "", 0, 0, kPitched},
    {"car", "wro_lap", Mode::kLog, ""},
    {"car in text", "wro_lap", Mode::kText, "set gyro.bias 0.5\rcalibrate\r"},
    {"car with losses", "wro_lap", Mode::kLog, "set correct.pose on\r", 17, 9},
    {"car pitched", "wro_lap", Mode::kText, "", 0, 0, kPitched},
};
// Asked at the end of each run.
constexpr const char* kQuestions[] = {"status", "objects", "map", "next", "next 1", "sectors", "ways", "calibrate"};
constexpr std::uint32_t kDrives = 100;  // random ones, for each profile
constexpr const char* kTable = "/tests/firmware/loop/golden_runs.csv";

std::uint64_t digest_of(const std::string& text) {
  base::Fnv1a64 hash;
  for (const char c : text) hash.u8(static_cast<std::uint8_t>(c));
  return hash.value();
}

// A setting of a log as the console takes it.
std::string typed(const std::string& setting) {
  const std::size_t comma = setting.find(',', 7);
  return "set " + setting.substr(7, comma - 7) + " " + setting.substr(comma + 1, setting.find('*') - comma - 1);
}

template <class Profile>
std::string finish(Desk<Profile>& desk, std::string said, std::string& state) {
  for (int i = 0; i < 3; ++i) {  // nothing comes any more
    desk.now = desk.now + base::milliseconds(700);
    desk.turn();
    said += desk.link.take_said();
  }
  for (const char* question : kQuestions) said += desk.type_line(question);
  char digest[20];
  std::snprintf(digest, sizeof digest, "%016" PRIx64, desk.memory().map.digest());
  state = digest;
  return said;
}

// The clock runs with the records.
template <class Profile>
std::string drive(const Run& run, std::string& state) {
  Desk<Profile> desk(run.mode);
  std::string said = desk.type(run.first);
  std::ifstream file(FENCEPOST_SOURCE_DIR "/host/share/recordings/" + std::string(run.recording) + ".log");
  unsigned number = 0;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("$FPHDR")) continue;  // the desk has begun its own run
    if (run.camera != nullptr && line.starts_with("$FPCAM")) line = record::sealed(run.camera);
    if (line.starts_with("$FPCFG,")) line = typed(line);
    const bool timed = line.starts_with("$FPODO") || line.starts_with("$FPCAR") || line.starts_with("$FPFRM");
    if (timed) desk.now = std::max(desk.now, base::Time::nearest(std::strtod(line.c_str() + 7, nullptr)));
    number += timed ? 1U : 0U;
    if (timed && run.lost != 0 && number % run.lost == 0) continue;
    if (timed && run.harmed != 0 && number % run.harmed == 0) line[line.size() / 2] = '#';
    desk.link.type(line + "\n");
    desk.turn();
    said += desk.link.take_said();
  }
  EXPECT_GT(number, 90U) << run.recording;
  return finish(desk, std::move(said), state);
}

// Twenty seconds.
template <class Profile>
std::string draw(std::uint32_t seed, std::string& state) {
  RandomDrive drive(seed);
  Desk<Profile> desk(seed % 3 == 0 ? Mode::kText : Mode::kLog);
  std::string said = desk.type(drive.first());
  for (int i = 0; i < 1000; ++i) {
    double t = 0;
    desk.link.type(drive.next(t));
    desk.now = std::max(desk.now, base::Time::nearest(t));
    desk.turn(3);
    said += desk.link.take_said();
  }
  return finish(desk, std::move(said), state);
}

std::map<std::string, std::string> table() {
  std::ifstream file(FENCEPOST_SOURCE_DIR + std::string(kTable));
  std::map<std::string, std::string> rows;
  for (std::string line; std::getline(file, line);) {
    const std::size_t key = line.find(',', line.find(',') + 1);
    if (key != std::string::npos) rows[line.substr(0, key)] = line.substr(key + 1);
  }
  return rows;
}

std::string drawn(std::string_view profile, std::uint32_t seed, std::string& state) {
  if (profile == "micro") return draw<config::Micro>(seed, state);
  if (profile == "small") return draw<config::Small>(seed, state);
  return draw<config::Full>(seed, state);
}
std::string driven(std::string_view profile, const Run& run, std::string& state) {
  if (profile == "micro") return drive<config::Micro>(run, state);
  if (profile == "small") return drive<config::Small>(run, state);
  return drive<config::Full>(run, state);
}

void compare(const std::string& key, const std::string& state, const std::string& said) {
  char row[40];
  std::snprintf(row, sizeof row, "%s,%016" PRIx64, state.c_str(), digest_of(said));
  if (const char* folder = std::getenv("FENCEPOST_GOLDEN")) {
    std::ofstream(std::string(folder) + "/golden_runs.csv", std::ios::app) << key << "," << row << "\n";
    std::ofstream(std::string(folder) + "/" + key + ".txt") << said;
  }
  EXPECT_EQ(row, table()[key]) << key << ": state, and what was said; see the head of this file";
}

class GoldenRuns : public testing::TestWithParam<std::tuple<const char*, Run>> {};
TEST_P(GoldenRuns, EndInTheSameStateAndSayTheSame) {
  const auto& [profile, run] = GetParam();
  std::string state;
  const std::string said = driven(profile, run, state);
  compare(std::string(profile) + "," + run.name, state, said);
}
INSTANTIATE_TEST_SUITE_P(All, GoldenRuns,
                         testing::Combine(testing::Values("micro", "small", "full"), testing::ValuesIn(kRuns)));

class GoldenDrives : public testing::TestWithParam<std::tuple<const char*, std::uint32_t>> {};
TEST_P(GoldenDrives, EndInTheSameStateAndSayTheSame) {
  const auto& [profile, seed] = GetParam();
  std::string state;
  const std::string said = drawn(profile, seed, state);
  compare(std::string(profile) + ",drive " + std::to_string(seed), state, said);
}
INSTANTIATE_TEST_SUITE_P(All, GoldenDrives,
                         testing::Combine(testing::Values("micro", "small", "full"), testing::Range(1U, kDrives + 1)));

TEST(GoldenRunsTable, HasARowForEachRunAndNoOther) { EXPECT_EQ(table().size(), 3 * (std::size(kRuns) + kDrives)); }

}  // namespace
}  // namespace fencepost::test
