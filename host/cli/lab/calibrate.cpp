#include <fmt/format.h>

#include <charconv>
#include <numbers>
#include <optional>

#include "host/calibrate/calibrate.hpp"
#include "host/calibrate/calibrated_robot.hpp"
#include "host/calibrate/calibration_picture.hpp"
#include "host/calibrate/calibration_text.hpp"
#include "host/cli/files.hpp"
#include "host/cli/lab.hpp"
#include "host/cli/log_input.hpp"
#include "host/cli/progress.hpp"
#include "host/cli/replay_run.hpp"
#include "host/cli/terminal.hpp"
#include "host/live/record_line.hpp"
#include "host/text/printable.hpp"

namespace fencepost::host::cli {
namespace {

constexpr double kLongest = 10;  // m, of a block or between two

/// A length in metres. errors: Failure (kUsage)
double length_of(std::string_view text, const std::string& option, const std::string& form) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !(value > 0 && value <= kLongest)) {
    throw Failure(Exit::kUsage, fmt::format("{}: \"{}\" is no length from 0 to {} m; write {}", option, printable(text),
                                            kLongest, form));
  }
  return value;
}

/// "red=0.05" is round and so wide, "red=0.05x0.08" a box: its mean width is its outline over pi.
NamedSize size_of(const std::string& text) {
  constexpr const char* kForm = "NAME=DIAMETER or NAME=AxB, for example red=0.05x0.08";
  const std::size_t equals = text.rfind('=');
  if (equals == std::string::npos || equals == 0) {
    throw Failure(Exit::kUsage, fmt::format("--size: \"{}\" names no block; write {}", printable(text), kForm));
  }
  const std::string_view lengths = std::string_view(text).substr(equals + 1);
  const std::size_t cross = lengths.find('x');
  const double a = length_of(lengths.substr(0, cross), "--size", kForm);
  if (cross == std::string_view::npos) return {text.substr(0, equals), a};
  const double b = length_of(lengths.substr(cross + 1), "--size", kForm);
  return {text.substr(0, equals), 2 * (a + b) / std::numbers::pi};
}

NamedDistance distance_of(const std::string& text) {
  constexpr const char* kForm = "NAME,NAME=METRES, for example red,blue=0.80";
  const std::size_t comma = text.find(',');
  const std::size_t equals = text.rfind('=');
  if (comma == std::string::npos || equals == std::string::npos || comma == 0 || equals < comma + 2) {
    throw Failure(Exit::kUsage,
                  fmt::format("--distance: \"{}\" names no two blocks; write {}", printable(text), kForm));
  }
  return {text.substr(0, comma), text.substr(comma + 1, equals - comma - 1),
          length_of(std::string_view(text).substr(equals + 1), "--distance", kForm)};
}

void check_usage(const CalibrateRequest& request) {
  if (request.from && request.to && *request.from > *request.to) {
    throw Failure(Exit::kUsage, "--from is later than --to; swap them");
  }
  int inputs = 0;
  for (const std::string& file : {request.log, request.camera, request.robot}) inputs += file == "-" ? 1 : 0;
  if (inputs > 1) throw Failure(Exit::kUsage, "only one of LOG, --camera and --robot can be standard input");
  int outputs = 0;
  for (const std::string& file : {request.output, request.write_camera, request.write_robot, request.picture}) {
    outputs += is_standard_output(file) ? 1 : 0;
  }
  if (outputs > 1) {
    throw Failure(Exit::kUsage, "only one of the outputs can be standard output; name a file with -o");
  }
}

CalibrateOptions options_of(const CalibrateRequest& request) {
  CalibrateOptions options;
  options.from = request.from;
  options.to = request.to;
  for (const std::string& size : request.sizes) options.sizes.push_back(size_of(size));
  for (const std::string& apart : request.distances) options.distances.push_back(distance_of(apart));
  if (!request.camera.empty()) options.camera = read_camera(request.camera);
  return options;
}

/// Everything is made before anything is written.
void write_all(const CalibrateRequest& request, const Calibration& calibration, const std::string& base) {
  std::string robot;
  if (!request.write_robot.empty()) {
    const auto made = calibrated_robot(calibration, base, input_name(request.robot));
    if (!made) throw Failure(Exit::kUnreadable, made.error().message);
    robot = *made;
  }
  if (!request.write_camera.empty()) write_output(request.write_camera, record_line(calibration.found));
  if (!request.write_robot.empty()) write_output(request.write_robot, robot);
  if (!request.picture.empty()) write_output(request.picture, calibration_picture(calibration));
  write_output(request.output,
               request.json ? calibration_json(calibration) : calibration_text(calibration, input_name(request.log)));
}

}  // namespace

Exit run_calibrate(const CalibrateRequest& request) {
  check_usage(request);
  CalibrateOptions options = options_of(request);
  const std::string base = request.robot.empty() ? "" : read_input(request.robot);
  std::optional<Progress> progress(std::in_place, "calibrating", OffTerminal::kLines);
  options.progress = [&](double share) { progress->at(share, 1); };
  const CalibrateOutcome outcome = calibrate(read_log(request.log), input_name(request.log), options);
  progress.reset();
  if (outcome.replay.unreadable) throw Failure(Exit::kUnreadable, outcome.replay.unreadable->message);
  if (!outcome.calibration) throw Failure(outcome.usage ? Exit::kUsage : Exit::kUnreadable, outcome.refusal);
  say_what_was_left_out(outcome.replay);
  write_all(request, *outcome.calibration, base);
  for (const std::string& note : outcome.calibration->notes) say(note);
  if (outcome.calibration->complete()) return Exit::kDone;
  for (const Finding& finding : outcome.calibration->findings) {
    if (finding.observed || !finding.essential) continue;
    say(fmt::format("{} is not found from this log and stays as configured: {}", finding.label, finding.motion));
  }
  return Exit::kCheckFailed;
}

}  // namespace fencepost::host::cli
