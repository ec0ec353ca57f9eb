#include <fmt/format.h>

#include <map>
#include <memory>

#include "host/cli/command.hpp"
#include "host/cli/files.hpp"
#include "host/cli/import_takes.hpp"
#include "host/cli/positive.hpp"
#include "host/cli/terminal.hpp"
#include "host/import/import.hpp"
#include "host/scene/load.hpp"

namespace fencepost::host::cli {
namespace {}  // namespace

Exit finish_import(const ImportResult& imported, const std::string& output) {
  if (!imported.ok()) throw Failure(Exit::kUnreadable, imported.error().message());
  write_output(output, imported->log);
  const ImportSummary& summary = imported->summary;
  say(fmt::format("{} frames with {} blobs, {} odometry samples", summary.frames, summary.blobs, summary.odometry));
  for (const auto& [what, count] : summary.skipped) say(fmt::format("left out: {} {}", count, what));
  for (const std::string& note : summary.notes) say(note);
  return Exit::kDone;
}

namespace {

struct ImportRequest {
  std::string source;
  std::string truth;
  std::string output = "-";
  MrclamOptions mrclam;
};

Exit finish(const ImportResult& imported, const ImportRequest& request) {
  if (!imported.ok()) throw Failure(Exit::kUnreadable, imported.error().message());
  if (!request.truth.empty()) {
    if (!imported->truth)
      throw Failure(Exit::kUnreadable, request.source + ": its truth is not known; leave out --truth");
    write_output(request.truth, write_scene(*imported->truth));
  }
  return finish_import(imported, request.output);
}

void add_outputs(CLI::App& app, ImportRequest& request) {
  app.add_option("--truth", request.truth, "also write what is known of the world, as a scene")->type_name("FILE");
  app.add_option("-o,--output", request.output, "where to write the log; default: standard output")->type_name("LOG");
}

Exit run_mrclam(const ImportRequest& request) {
  if (is_standard_output(request.output) && is_standard_output(request.truth)) {
    throw Failure(Exit::kUsage, "the log and --truth cannot both be standard output; name a file with -o");
  }
  if (request.mrclam.from && request.mrclam.to && *request.mrclam.from > *request.mrclam.to) {
    throw Failure(Exit::kUsage, "--from is later than --to; swap them");
  }
  return finish(import_mrclam(request.source, request.mrclam), request);
}

Action configure_mrclam(CLI::App& app) {
  const auto request = std::make_shared<ImportRequest>();
  static const std::map<std::string, PoseSource> kPoses = {{"truth", PoseSource::kTruth},
                                                           {"odometry", PoseSource::kOdometry}};
  app.add_option("DIR", request->source, "the folder with RobotN_*.dat, Barcodes.dat and Landmark_Groundtruth.dat")
      ->required();
  app.add_option("--robot", request->mrclam.robot, "which robot; needed where the folder has several")->type_name("N");
  app.add_option("--poses", request->mrclam.poses, "truth: surveyed; odometry: integrated from wheel speeds")
      ->transform(CLI::CheckedTransformer(kPoses))
      ->option_text("truth|odometry [truth]");
  app.add_option("--diameter", request->mrclam.diameter, "m, assumed of every landmark; default 0.12")
      ->type_name("D")
      ->check(positive());
  app.add_option("--from", request->mrclam.from, "s from the recording's start")->type_name("T");
  app.add_option("--to", request->mrclam.to, "s from the recording's start")->type_name("T");
  app.add_flag("--rows", request->mrclam.rows, "ranges also as ground rows of a level camera 0.3 m above the floor");
  app.add_flag("--include-robots", request->mrclam.include_robots, "also the other robots, which move");
  add_outputs(app, *request);
  return [request] { return run_mrclam(*request); };
}

Action configure_rings(CLI::App& app) {
  const auto request = std::make_shared<ImportRequest>();
  app.add_option("CSV", request->source, "bearing intervals, one view a line")->required();
  add_outputs(app, *request);
  return [request] { return finish(import_rings(request->source), *request); };
}

}  // namespace

Command import_command() {
  const Command mrclam = {
      "mrclam",
      "the UTIAS multi-robot recordings",
      "  fencepost import mrclam MRCLAM_Dataset1 --robot 1 --to 120 -o mrclam.log --truth mrclam.json\n",
      configure_mrclam,
      {}};
  const Command rings = {"rings",
                         "bearing intervals of one object, as CSV",
                         "  fencepost import rings box.csv -o box.log\n",
                         configure_rings,
                         {}};
  std::vector<Command> children = {mrclam, rings};
  for (Command& command : take_commands()) children.push_back(std::move(command));
  std::string examples;
  for (const Command& command : children) examples += command.examples.substr(0, command.examples.find('\n') + 1);
  return {"import", "recordings of others as a record stream", examples, nullptr, children};
}

}  // namespace fencepost::host::cli
