#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "host/cli/alert_spool.hpp"
#include "host/cli/command.hpp"
#include "host/cli/files.hpp"
#include "host/cli/replay_run.hpp"
#include "host/cli/terminal.hpp"
#include "host/doctor/log/difference.hpp"
#include "host/result/text.hpp"
#include "host/result/to_json.hpp"

namespace fencepost::host::cli {
namespace {

struct ReplayRequest {
  std::string log;
  std::string camera;
  std::string write_log;
  std::vector<double> pose_noise;  ///< mm, mrad
  std::string output = "-";
  bool json = false;
  bool passes = false;
  std::vector<std::string> sides;  ///< NAME=left|right
  std::vector<std::string> diff;   ///< two logs
  ReplayOptions options;
};

void check_usage(const ReplayRequest& request) {
  if (request.log.empty()) throw Failure(Exit::kUsage, "LOG is required; see fencepost replay --help");
  if (request.log == "-" && request.camera == "-") {
    throw Failure(Exit::kUsage, "LOG and --camera cannot both be standard input; put one into a file");
  }
  if (is_standard_output(request.output) && is_standard_output(request.write_log)) {
    throw Failure(Exit::kUsage, "the result and --write-log cannot both be standard output; name a file with -o");
  }
  if (request.options.from && request.options.to && *request.options.from > *request.options.to) {
    throw Failure(Exit::kUsage, "--from is later than --to; swap them");
  }
}

std::vector<SideRule> read_sides(const std::vector<std::string>& words) {
  std::vector<SideRule> sides;
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    const std::string side = equals == std::string::npos ? "" : word.substr(equals + 1);
    if (side != "left" && side != "right") {
      throw Failure(Exit::kUsage, "--sides: '" + word + "' says no side; write a name and a side, such as red=right");
    }
    sides.push_back({word.substr(0, equals), side == "right"});
  }
  return sides;
}

Exit judge_sides(const ResultDocument& result, const std::vector<SideRule>& sides) {
  const std::size_t wrong = wrong_sides(result, sides);
  if (wrong == 0) return Exit::kDone;
  say(fmt::format("{} of {} were passed on the wrong side", wrong, result.passes.size()));
  return Exit::kCheckFailed;
}

/// Colours only where the text goes to a terminal, not into a file.
void write_text(const ResultDocument& result, const AlertSpool& alerts, bool to_standard_output, OutputFile& out) {
  TextOptions text;
  text.colour = to_standard_output && colour_on_stdout();
  alerts.each([&](const record::AlertReport& alert) { out.write(alert_sentence(result, alert, text) + "\n"); });
  if (alerts.count() > 0) out.write("\n");
  out.write(object_table(result, text) + "\n");
  const std::string doubts = calibration_list(result);
  out.write(doubts + (doubts.empty() ? "" : "\n") + summary_line(result, alerts.count()));
}

void write_result(const ReplayRequest& request, const ResultDocument& result, const AlertSpool& alerts,
                  const std::vector<SideRule>& sides) {
  OutputFile out(request.output);
  if (request.json) {
    write_json(
        result, [&](const auto& visit) { alerts.each(visit); }, [&](std::string_view part) { out.write(part); });
  } else if (request.passes || !sides.empty()) {
    out.write(pass_table(result, sides));
  } else {
    write_text(result, alerts, is_standard_output(request.output), out);
  }
  out.finish();
}

Exit judge(const CheckOutcome& check) {
  for (const std::string& mismatch : check.mismatches) say(mismatch);
  if (check.differing > 0) {
    say(fmt::format("check failed: {} of {} logged records differ; same version and --profile as the robot?",
                    check.differing, check.compared));
    return Exit::kCheckFailed;
  }
  if (check.damaged > 0) {
    say(fmt::format(
        "check failed: {} of the robot's own records cannot be read, first in line {}; what they said is not "
        "compared. Check cable and card, and record again",
        check.damaged, check.first_damaged));
    return Exit::kCheckFailed;
  }
  if (check.compared == 0) {
    say("check failed: nothing to compare; record in console mode log, which writes FPOBJ, FPALR and FPDIG");
    return Exit::kCheckFailed;
  }
  say(fmt::format("check passed: {} logged records agree", check.compared));
  return Exit::kDone;
}

/// Settings, calibration and alerts of two logs beside each other.
Exit run_difference(const ReplayRequest& request) {
  if (!request.log.empty()) throw Failure(Exit::kUsage, "--diff has its two logs behind it; leave out " + request.log);
  const auto survey = [](const std::string& path) {
    LogInput input(path);
    doctor::LogSurvey log = doctor::survey_log([&] { return input.next(); }, input_name(path));
    if (log.replayed.unreadable) throw Failure(Exit::kUnreadable, log.replayed.unreadable->message);
    return log;
  };
  const doctor::LogSurvey first = survey(request.diff[0]);
  const doctor::LogSurvey second = survey(request.diff[1]);
  const doctor::Difference difference = doctor::difference_of(first, second);
  write_output(request.output, request.json ? doctor::difference_json(difference).dump(2) + "\n"
                                            : doctor::difference_text(difference, first.name, second.name));
  return difference.any() ? Exit::kCheckFailed : Exit::kDone;
}

Exit run(ReplayRequest request) {
  if (!request.diff.empty()) return run_difference(request);
  check_usage(request);
  const std::vector<SideRule> sides = read_sides(request.sides);
  if (!request.camera.empty()) request.options.camera = read_camera(request.camera);
  if (!request.pose_noise.empty()) {
    request.options.pose_noise = PoseNoise{1e-3 * request.pose_noise[0], 1e-3 * request.pose_noise[1]};
  }
  LogInput input(request.log);
  std::optional<OutputFile> own_log;
  if (!request.write_log.empty()) {
    own_log.emplace(request.write_log);
    request.options.log = [&](std::string_view line) { own_log->write(line); };
  }
  AlertSpool alerts;
  request.options.alerts = &alerts;
  const ReplayOutcome outcome = replay_input(input, request.log, request.options);
  if (own_log) own_log->finish();
  own_log.reset();
  write_result(request, outcome.result, alerts, sides);
  say_what_was_left_out(outcome);
  if (!sides.empty() && !request.options.check) return judge_sides(outcome.result, sides);
  return request.options.check ? judge(outcome.check) : Exit::kDone;
}

Action configure_replay(Options command) {
  const auto request = std::make_shared<ReplayRequest>();
  command.positional("LOG", request->log, "a recorded stream; - is standard input");
  command.value("--diff", request->diff, "instead: settings, calibration and alerts of two logs; exit 1 if they differ")
      .takes("A B")
      .count(2);
  command.profile(request->options.profile);
  command.flag("--json", request->json, "write the result document instead of text");
  command.flag("--passes", request->passes, "instead: what was driven past, on which side, how near");
  command.value("--sides", request->sides, "the same, and where each has to be passed; exit 1 if one was not")
      .takes("NAME=left|right,...")
      .separated_by(',');
  command.flag(
      "--check", request->options.check,
      "compare logged FPOBJ, FPALR, FPALV, FPSPD, FPCAL and FPDIG with our own; exit 1 if they differ or are damaged");
  command.value("--from", request->options.from, "s, stream time; earlier records are not used").takes("T");
  command.value("--to", request->options.to, "s, stream time; later records are not used").takes("T");
  command.value("--frames", request->options.frames, "stop after the N-th frame record").takes("N").positive();
  command.value("--run", request->options.run, "of a log of several runs the N-th; default: its last")
      .takes("N")
      .positive();
  command
      .value("--camera", request->camera,
             "a file with an FPCAM line, a scene, its \"camera\", or OpenCV's YAML: for logs without FPCAM")
      .takes("FILE");
  command
      .value("--pose-noise", request->pose_noise,
             "sigmas of each pose; default 4,7: a robot that drives. Calibrated cameras: less")
      .takes("MM,MRAD")
      .separated_by(',')
      .count(2)
      .positive();
  command.value("--write-log", request->write_log, "the log that a robot would have written for these inputs")
      .takes("FILE");
  command.value("-o,--output", request->output, "where to write; default: standard output").takes("FILE");
  return [request] { return run(*request); };
}

}  // namespace

Command replay_command() {
  return {"replay",
          "alerts and objects of a recorded run",
          "  fencepost replay run.log\n"
          "  fencepost replay run.log --json | jq '.objects[0].models.clip.geometry'\n"
          "  fencepost replay robot.log --check\n"
          "  fencepost replay --diff yesterday.log today.log\n",
          configure_replay,
          {}};
}

}  // namespace fencepost::host::cli
