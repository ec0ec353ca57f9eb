#include "host/cli/files.hpp"
#include "host/cli/import_takes.hpp"
#include "host/cli/lab.hpp"
#include "host/import/import.hpp"
#include "host/scene/load.hpp"

namespace fencepost::host::cli {
namespace {

Exit finish(const ImportResult& imported, const SetRequest& request) {
  if (!imported.ok()) throw Failure(Exit::kUnreadable, imported.error().message());
  if (!request.truth.empty()) {
    if (!imported->truth)
      throw Failure(Exit::kUnreadable, request.source + ": its truth is not known; leave out --truth");
    write_output(request.truth, write_scene(*imported->truth));
  }
  return finish_import(imported, request.output);
}

void expect_two_outputs(const SetRequest& request) {
  if (!is_standard_output(request.output) || !is_standard_output(request.truth)) return;
  throw Failure(Exit::kUsage, "the log and --truth cannot both be standard output; name a file with -o");
}

}  // namespace

Exit run_import_mrclam(const SetRequest& request) {
  expect_two_outputs(request);
  if (request.from && request.to && *request.from > *request.to) {
    throw Failure(Exit::kUsage, "--from is later than --to; swap them");
  }
  MrclamOptions options;
  options.robot = request.robot;
  options.poses = request.poses == "truth" ? PoseSource::kTruth : PoseSource::kOdometry;
  options.diameter = request.diameter;
  options.from = request.from;
  options.to = request.to;
  options.rows = request.rows;
  options.include_robots = request.include_robots;
  return finish(import_mrclam(request.source, options), request);
}

Exit run_import_cycloid(const SetRequest& request, const std::string& cones) {
  expect_two_outputs(request);
  return finish(import_cycloid(request.source, cones), request);
}

Exit run_import_victoria(const SetRequest& request, const VictoriaOptions& options) {
  return finish(import_victoria(request.source, options), request);
}

Exit run_import_dlr(const SetRequest& request, const DlrOptions& options) {
  return finish(import_dlr(request.source, options), request);
}

Exit run_import_kitti(const SetRequest& request, const KittiOptions& options) {
  expect_two_outputs(request);
  return finish(import_kitti(request.source, options), request);
}

Exit run_import_rings(const SetRequest& request) { return finish(import_rings(request.source), request); }

}  // namespace fencepost::host::cli
