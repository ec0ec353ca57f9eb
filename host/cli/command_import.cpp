#include <fmt/format.h>

#include <memory>
#include <numbers>

#include "host/cli/command.hpp"
#include "host/cli/files.hpp"
#include "host/cli/import_takes.hpp"
#include "host/cli/lab.hpp"
#include "host/cli/terminal.hpp"
#include "host/import/import.hpp"
#include "host/text/plural.hpp"

namespace fencepost::host::cli {

Exit finish_import(const ImportResult& imported, const std::string& output) {
  if (!imported.ok()) throw Failure(Exit::kUnreadable, imported.error().message());
  write_output(output, imported->log);
  const ImportSummary& summary = imported->summary;
  say(fmt::format("{} with {}, {}", plural(summary.frames, "frame"), plural(summary.blobs, "blob"),
                  plural(summary.odometry, "odometry sample")));
  for (const auto& [what, count] : summary.skipped) say(fmt::format("left out: {} ({})", what, count));
  for (const std::string& note : summary.notes) say(note);
  return Exit::kDone;
}

namespace {

void add_outputs(Options command, SetRequest& request) {
  command.value("--truth", request.truth, "also write what is known of the world, as a scene").takes("FILE");
  command.value("-o,--output", request.output, "where to write the log; default: standard output").takes("LOG");
}

Action configure_mrclam(Options command) {
  const auto request = std::make_shared<SetRequest>();
  command.positional("DIR", request->source, "the folder with RobotN_*.dat, Barcodes.dat and Landmark_Groundtruth.dat")
      .required();
  command.value("--robot", request->robot, "which robot; needed where the folder has several").takes("N");
  command.value("--poses", request->poses, "truth: surveyed; odometry: integrated from wheel speeds")
      .one_of({"truth", "odometry"})
      .shown_as("truth|odometry [truth]");
  command.value("--diameter", request->diameter, "m, assumed of every landmark; default 0.12").takes("D").positive();
  command.value("--from", request->from, "s from the recording's start").takes("T");
  command.value("--to", request->to, "s from the recording's start").takes("T");
  command.flag("--rows", request->rows, "ranges also as ground rows of a level camera 0.3 m above the floor");
  command.flag("--include-robots", request->include_robots, "also the other robots, which move");
  add_outputs(command, *request);
  return [request] { return run_import_mrclam(*request); };
}

Action configure_rings(Options command) {
  const auto request = std::make_shared<SetRequest>();
  command.positional("CSV", request->source, "bearing intervals, one view a line").required();
  add_outputs(command, *request);
  return [request] { return run_import_rings(*request); };
}

Action configure_dlr(Options command) {
  struct DlrRequest {
    SetRequest set;
    DlrOptions options;
    std::uint32_t from = 0;
    std::optional<std::uint32_t> to;
  };
  const auto request = std::make_shared<DlrRequest>();
  command.positional("FILE", request->set.source, "map.circles: lines STEP and LANDMARK_C").required();
  command.flag("--identity", request->options.identity, "a signature for each disc; default: one for all");
  command.value("--from", request->from, "first step; default 0").takes("N");
  command.value("--to", request->to, "step at which it ends").takes("N");
  add_outputs(command, request->set);
  return [request] {
    request->options.from = request->from;
    if (request->to) request->options.to = *request->to;
    return run_import_dlr(request->set, request->options);
  };
}

Action configure_kitti(Options command) {
  struct KittiRequest {
    SetRequest set;
    KittiOptions options;
    std::optional<double> pitch;  // deg
  };
  const auto request = std::make_shared<KittiRequest>();
  command.positional("DIR", request->set.source, "a folder with labels.txt, calib.txt and poses.txt of one drive")
      .required();
  command.flag("--identity", request->options.identity, "a signature for each car; default: one for all");
  command.flag("--ids", request->options.ids, "the labels' tracks as ids of a camera that tracks; default: no ids");
  command
      .value("--detections", request->options.detections,
             "boxes of a detector in place of the labels: frame,x1,y1,x2,y2,score")
      .takes("FILE");
  command.value("--scale", request->options.scale, "lengths of the log over those of the world; default 0.1")
      .takes("S")
      .positive();
  command.value("--pitch", request->pitch, "deg, configured pitch of the camera; default: unknown, without rows")
      .takes("P")
      .within(-45.0, 45.0);
  add_outputs(command, request->set);
  return [request] {
    if (request->pitch) request->options.pitch = *request->pitch * std::numbers::pi / 180;
    return run_import_kitti(request->set, request->options);
  };
}

Action configure_cycloid(Options command) {
  struct CycloidRequest {
    SetRequest set;
    std::string cones;
  };
  const auto request = std::make_shared<CycloidRequest>();
  command.positional("FILE", request->set.source, "frames \"dt ds gyro n\", each with n bearings").required();
  command.value("--cones", request->cones, "the surveyed cones, lm.txt; then --truth knows them").takes("FILE");
  add_outputs(command, request->set);
  return [request] { return run_import_cycloid(request->set, request->cones); };
}

Action configure_victoria(Options command) {
  struct VictoriaRequest {
    SetRequest set;
    VictoriaOptions options;
  };
  const auto request = std::make_shared<VictoriaRequest>();
  command.positional("DIR", request->set.source, "a folder with measurements.dat and inputs.dat").required();
  command.flag("--rows", request->options.rows, "ranges also as ground rows of a level camera 2 m above the ground");
  command.value("--scale", request->options.scale, "lengths of the log over those of the world; default 0.1")
      .takes("S")
      .positive();
  command.value("--from", request->options.from, "s of the recording's clock").takes("T");
  command.value("--to", request->options.to, "s of the recording's clock").takes("T");
  command.value("-o,--output", request->set.output, "where to write the log; default: standard output").takes("LOG");
  return [request] { return run_import_victoria(request->set, request->options); };
}

}  // namespace

Command import_command() {
  const Command mrclam = {
      "mrclam",
      "the UTIAS multi-robot recordings",
      "  fencepost import mrclam MRCLAM_Dataset1 --robot 1 --to 120 -o mrclam.log --truth mrclam.json\n",
      configure_mrclam,
      {},
      true};
  const Command rings = {"rings",
                         "bearing intervals of one object, as CSV",
                         "  fencepost import rings box.csv -o box.log\n",
                         configure_rings,
                         {},
                         true};
  const Command kitti = {"kitti",
                         "cars along the drives of KITTI's tracking data set, at a tenth of their size",
                         "  fencepost import kitti 0001 --identity --pitch 0 -o kitti.log --truth kitti.json\n",
                         configure_kitti,
                         {},
                         true};
  const Command dlr = {"dlr",
                       "white discs on the floor of a building, from DLR's spatial cognition data set",
                       "  fencepost import dlr map.circles --identity --to 100 -o dlr.log\n",
                       configure_dlr,
                       {},
                       true};
  const Command cycloid = {"cycloid",
                           "orange cones around a 1:10 car with a gyro, as bearings",
                           "  fencepost import cycloid 194625.txt --cones lm.txt -o cones.log --truth cones.json\n",
                           configure_cycloid,
                           {},
                           true};
  const Command victoria = {"victoria",
                            "trees around the truck of the Victoria Park data set, at a tenth of their size",
                            "  fencepost import victoria victoria_park --rows -o trees.log\n",
                            configure_victoria,
                            {},
                            true};
  std::vector<Command> children = {mrclam, kitti, dlr, cycloid, victoria, rings};
  for (Command& command : take_commands()) children.push_back(std::move(command));
  std::string examples;
  for (const Command& command : children) examples += command.examples.substr(0, command.examples.find('\n') + 1);
  return {"import", "recordings of others as a record stream", examples, nullptr, children};
}

}  // namespace fencepost::host::cli
