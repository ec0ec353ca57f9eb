// One fault a drive, and what `find_causes` makes of it: a table of faults against the causes named.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "tests/studies/calibrate/faulty_drive.hpp"
#include "tests/studies/common/study.hpp"

namespace fencepost::test {
namespace {

constexpr std::string_view kCauses[] = {"focal", "yaw",   "pitch", "latency", "height",
                                        "ways",  "turns", "curve", "pad",     "width"};

struct Request {
  Seeds seeds{40, 41'001};
  DriveOptions drive;
  std::string fault;
  double most = 0.05;  ///< share of the drives
  bool judge = true;
  bool verbose = false;
};

/// The cause that has to be named.
std::optional<host::CauseKind> name_of(Fault fault) {
  using enum host::CauseKind;
  switch (fault) {
    case Fault::kNone:
    case Fault::kPadOne: return std::nullopt;  // one thing of a colour may be of another shape
    case Fault::kPadAll: return kPad;
    case Fault::kTilt: return kPitch;
    case Fault::kWidth: return kWidth;
    case Fault::kTurns: return kTurn;
    case Fault::kWays: return kStep;
    case Fault::kFocal: return kFocal;
    case Fault::kYaw: return kYaw;
    case Fault::kLatency: return kLatency;
    case Fault::kHeight: return kHeight;
  }
  return std::nullopt;
}

std::string_view word(host::CauseKind kind) { return kCauses[static_cast<std::size_t>(kind)]; }

void show(const host::Cause& cause, std::string_view fault, unsigned seed) {
  std::string line = fmt::format("  {} {}: {}{} given {:.4f} found {:.4f} +- {:.4f}, {} objects, {} sightings", fault,
                                 seed, word(cause.kind), cause.signature ? fmt::format(" of {}", *cause.signature) : "",
                                 cause.configured, cause.found, cause.sigma, cause.objects, cause.sightings);
  for (const host::CauseKind other : cause.or_else) line += fmt::format(" or {}", word(other));
  print(line + "\n");
}

/// One row of the table. False: another cause was named in more drives than allowed, or the fault in too few.
bool judge(const Request& request, Fault fault) {
  const std::string_view fault_name = kFaultNames[static_cast<std::size_t>(fault)];
  std::map<host::CauseKind, unsigned> named;
  unsigned nothing = 0;
  unsigned others = 0;
  unsigned unsure = 0;
  for (unsigned i = 0; i < request.seeds.scenes; ++i) {
    DriveOptions options = request.drive;
    options.seed = request.seeds.first + i;
    const bool widths = fault == Fault::kWidth || fault == Fault::kWays || i % 2 == 0;
    host::ReplayOutcome replayed;
    host::ReplayOptions how;
    how.profile = "full";
    const auto [causes, is_part, moving, sideways, several] =
        host::find_causes(host::read_drive(faulty_drive(options, fault, widths), "drive", how, replayed));
    if (request.verbose && (is_part || moving > 0 || sideways || several)) {
      print(fmt::format("  {} {}:{} moving {:.3f}{}{}\n", fault_name, options.seed, is_part ? " part" : "", moving,
                        sideways ? " sideways" : "", several ? " several" : ""));
    }
    nothing += causes.empty() ? 1U : 0U;
    const auto is_other = [&](const host::Cause& cause) { return cause.kind != name_of(fault); };
    others += std::ranges::any_of(causes, is_other) ? 1U : 0U;
    unsure += std::ranges::any_of(causes, [](const host::Cause& c) { return !c.or_else.empty(); }) ? 1U : 0U;
    std::map<host::CauseKind, unsigned> here;
    for (const host::Cause& cause : causes) {
      here[cause.kind] = 1;
      if (request.verbose) show(cause, fault_name, options.seed);
    }
    for (const auto& [kind, one] : here) named[kind] += one;
  }
  std::string line = fmt::format("| {} |", fault_name);
  for (std::size_t c = 0; c < std::size(kCauses); ++c) {
    const unsigned count = named[static_cast<host::CauseKind>(c)];
    line += count == 0 ? " |" : fmt::format(" {} |", count);
  }
  print(line + fmt::format(" {} | {} |\n", nothing, unsure));
  const auto allowed = static_cast<unsigned>(request.most * request.seeds.scenes);
  const auto expected = name_of(fault);
  return others <= allowed && (!expected || named[*expected] + allowed >= request.seeds.scenes);
}

bool run(const Request& request) {
  std::string line = "| fault |";
  std::string rule = "|---|";
  for (const std::string_view cause : kCauses) {
    line += fmt::format(" {} |", cause);
    rule += "---|";
  }
  print(line + " nothing | or else |\n" + rule + "---|---|\n");
  bool good = true;
  for (std::size_t f = 0; f < std::size(kFaultNames); ++f) {
    if (!request.fault.empty() && request.fault != kFaultNames[f]) continue;
    good = judge(request, static_cast<Fault>(f)) && good;
  }
  return good || !request.judge;
}

void options(CLI::App& app, Request& request) {
  add_seed_options(app, request.seeds, "random drives a fault", "--logs");
  app.add_option_function<int>(
         "--straights",
         [&request](int count) {
           request.drive.motion = Motion::kToAndFro;
           request.drive.straights = count;
         },
         "the longer drive: straight on to and fro so many times, 10 s each")
      ->check(CLI::Range(1, 40));
  app.add_option("--fisheye", request.drive.fisheye, "degrees across of an equidistant lens; 0: a Pixy2's")
      ->check(CLI::Range(0, 150))
      ->capture_default_str();
  app.add_option("--fault", request.fault, "only this one; default: each")
      ->check(CLI::IsMember(std::vector<std::string>(std::begin(kFaultNames), std::end(kFaultNames))));
  app.add_option("--most", request.most, "share of the drives that may be judged wrongly")->capture_default_str();
  app.add_flag("!--no-judgement", request.judge, "print only");
  app.add_flag("--verbose", request.verbose, "each cause");
}

constexpr Study<Request> kStudy = {"causes_study", "What is said of drives with one fault each.", options, run};

}  // namespace
}  // namespace fencepost::test

int main(int argc, char** argv) { return fencepost::test::kStudy.main(argc, argv); }
