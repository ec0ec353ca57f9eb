// A real robot whose odometry begins anew in mid-run: how soon does it know again where it is in the map that it had?
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "firmware/record/stream_reader.hpp"
#include "host/import/import.hpp"
#include "host/merge/merge.hpp"
#include "host/merge/move.hpp"
#include "host/merge/relocate.hpp"
#include "host/replay/replay.hpp"
#include "tests/firmware/record/lines.hpp"
#include "tests/studies/common/study.hpp"
#include "tests/studies/drift/real_run.hpp"

namespace fencepost::test {
namespace {

struct Request {
  std::vector<std::string> sets;
  std::string correct = "on";
  bool rows = false;
  int cuts = 6;
  bool verbose = false;
};

constexpr std::array<double, 4> kAfter = {15, 30, 60, 120};  // s
/// m, maximum error of a right pose, against the one that the robot has in the same map where nothing is cut.
constexpr double kRight = 0.5;
constexpr double kRightTurn = 15 * std::numbers::pi / 180;  // rad, the same of its heading

struct Recording {
  std::string name;
  std::string log;
  std::vector<host::PoseResult> path;  ///< corrected, without a cut
  std::vector<host::PoseResult> odometry;
};

struct OdometrySink {
  std::vector<host::PoseResult>& odometry;
  void accept(const sensor::OdometrySample& sample) {
    odometry.push_back({sample.t.to_double(), sample.x.to_double(), sample.y.to_double(), sample.heading.to_double()});
  }
  template <class Record>
  void accept(const Record& /*record*/) {}
};

host::ReplayOutcome replay(const Recording& recording, std::optional<double> to) {
  host::ReplayOptions options;
  options.profile = "full";
  options.to = to;
  host::ReplayOutcome outcome = host::replay(recording.log, recording.name, options);
  if (outcome.unreadable) throw std::runtime_error(outcome.unreadable->message);
  return outcome;
}

Recording load(const RealRun& run, const Request& request) {
  host::MrclamOptions import;
  import.robot = run.robot;
  import.poses = host::PoseSource::kOdometry;
  import.rows = request.rows;
  const host::ImportResult imported = host::import_mrclam(run.folder, import);
  if (!imported.ok()) throw std::runtime_error(imported.error().message());
  Recording recording{run.name, imported->log, {}, {}};
  for (const auto& [key, value] :
       {std::pair{"correct.pose", request.correct.c_str()}, std::pair{"correct.drift", "15"}})
    recording.log = with_setting(recording.log, record::Setting{std::string_view(key), std::string_view(value)});
  std::array<char, record::StreamReader::kBuffer> buffer{};
  record::StreamReader reader(buffer);
  OdometrySink sink{recording.odometry};
  reader.push(recording.log, sink);
  recording.path = replay(recording, {}).result.path;
  return recording;
}

host::PoseResult at(const std::vector<host::PoseResult>& path, double t) {
  const auto after = std::ranges::lower_bound(path, t, {}, &host::PoseResult::t);
  return after == path.end() ? path.back() : *after;
}

struct Counts {
  unsigned cuts = 0;
  std::array<unsigned, kAfter.size()> right{};
  std::array<unsigned, kAfter.size()> wrong{};
};

void cut(const Recording& recording, double t, const host::KnownPoints& known, bool strange, const Request& request,
         Counts& counts) {
  ++counts.cuts;
  host::RelocateOptions options;
  options.from = t;
  options.to = t + kAfter.back();
  const auto found = host::relocate(recording.log, known.points, options);
  if (!found) {
    if (request.verbose)
      print(fmt::format("{} {:.0f} s, {} known: not placed\n", recording.name, t, known.points.size()));
    return;
  }
  const double now = t + found->after;
  const host::PoseResult pose = host::Motion::of(found->motion).of(at(recording.odometry, now));
  const host::PoseResult truth = at(recording.path, now);
  const double off = std::hypot(pose.x - truth.x, pose.y - truth.y);
  const double turn = std::remainder(pose.heading - truth.heading, 2 * std::numbers::pi);
  const bool right = !strange && off <= kRight && std::fabs(turn) <= kRightTurn;
  for (std::size_t i = 0; i < kAfter.size(); ++i) {
    if (found->after <= kAfter[i]) ++(right ? counts.right : counts.wrong)[i];
  }
  if (request.verbose || !right) {
    print(fmt::format("{} {:.0f} s, {} known: after {:.1f} s by {}, doubt {:.1e}: off by {:.2f} m, {:.0f} deg{}\n",
                      recording.name, t, known.points.size(), found->after, found->found.met,
                      static_cast<double>(found->found.doubt), off, turn * 180 / std::numbers::pi,
                      right ? "" : " WRONG"));
  }
}

void print_counts(std::string_view name, const Counts& counts) {
  print(fmt::format("| {} | {} |", name, counts.cuts));
  for (std::size_t i = 0; i < kAfter.size(); ++i) print(fmt::format(" {} / {} |", counts.right[i], counts.wrong[i]));
  print("\n");
}

bool run(const Request& request) {
  Counts own;
  Counts strange;
  std::vector<std::pair<std::string, Recording>> recordings;
  for (const RealRun& real : real_runs()) {
    const std::string set = real.name.substr(0, 2);
    if (!present(real)) continue;
    if (!request.sets.empty() && std::ranges::find(request.sets, set) == request.sets.end()) continue;
    recordings.emplace_back(set, load(real, request));
  }
  if (recordings.empty()) {
    print("NOT TESTED: no recordings beside the checkout\n");
    return true;
  }
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    const auto& [set, recording] = recordings[r];
    const double begin = recording.odometry.front().t;
    const double length = recording.odometry.back().t - begin;
    for (int i = 0; i < request.cuts; ++i) {
      const double t = begin + length * (i + 2) / (request.cuts + 2.5);
      const host::KnownPoints known = host::known_points(replay(recording, t).result);
      cut(recording, t, known, false, request, own);
      // Landmarks of the same colours at other places.
      const auto other = std::ranges::find_if(recordings, [&](const auto& o) { return o.first != set; });
      if (other != recordings.end()) cut(other->second, begin + t, known, true, request, strange);
    }
  }
  print("| | cuts | right / wrong after 15 s | 30 s | 60 s | 120 s |\n|---|---|---|---|---|---|\n");
  print_counts("its own map", own);
  print_counts("the map of another place", strange);
  return strange.wrong.back() == 0;
}

void options(CLI::App& app, Request& request) {
  app.add_option("--sets", request.sets, "D1, D4, D6, D7; default: all")->delimiter(',');
  app.add_option("--correct", request.correct, "correct.pose before the cut")->capture_default_str();
  app.add_flag("--rows", request.rows, "ranges also as ground rows");
  app.add_option("--cuts", request.cuts, "a run")->capture_default_str();
  app.add_flag("--verbose", request.verbose, "a line for each cut");
}

}  // namespace
}  // namespace fencepost::test

int main(int argc, char** argv) {
  using namespace fencepost::test;
  return Study<Request>{"relocation_study",
                        "Odometry that begins anew in mid-run: when is the robot's place known again?", options, run}
      .main(argc, argv);
}
