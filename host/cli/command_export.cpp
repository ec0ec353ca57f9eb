#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <vector>

#include "host/cli/alert_spool.hpp"
#include "host/cli/command.hpp"
#include "host/cli/files.hpp"
#include "host/cli/lab.hpp"
#include "host/cli/log_input.hpp"
#include "host/cli/replay_run.hpp"
#include "host/cli/terminal.hpp"
#include "host/export/csv_list.hpp"
#include "host/export/drawing.hpp"
#include "host/export/geojson_map.hpp"
#include "host/export/glb.hpp"
#include "host/export/mcap/mcap.hpp"
#include "host/export/nav2_map.hpp"
#include "host/result/lookup.hpp"
#include "host/result/thinned.hpp"
#include "host/text/plural.hpp"

namespace fencepost::host::cli {
namespace {

struct ExportRequest {
  std::string log;
  std::string format;
  std::string output;
  std::string camera;
  std::string model;
  std::vector<double> at;  ///< latitude, longitude, bearing; deg
  double resolution = exports::kMapResolution;
  double interval = 0.2;
  double start = 0;
  double scale = 2;
  ReplayOptions options;
};

using Write = std::string (*)(const exports::Run&, const ExportRequest&);

struct Format {
  std::string_view name;
  std::string_view ending;  ///< of the file that it writes, and of a FILE that asks for it
  bool by_ending;           ///< of several formats with that ending, the one it asks for
  bool history;             ///< uses how objects came to be
  bool lab;                 ///< only the second program draws it
  Write write;
};

std::optional<exports::Anchor> anchor_of(const ExportRequest& request) {
  if (request.at.empty()) return std::nullopt;
  exports::Anchor anchor{request.at[0], request.at[1]};
  if (request.at.size() > 2) anchor.bearing = request.at[2];
  return anchor;
}

/// "maps/run.yaml" has its image beside it: "maps/run.pgm".
std::string image_beside(const std::string& yaml) {
  return std::filesystem::path(yaml).replace_extension(".pgm").string();
}

std::string write_nav2(const exports::Run& run, const ExportRequest& request) {
  if (is_standard_output(request.output)) {
    throw Failure(Exit::kUsage, "nav2 is two files, a YAML and a PGM; name the first with -o FILE.yaml");
  }
  const std::string image = image_beside(request.output);
  if (image == request.output) {
    throw Failure(Exit::kUsage, "-o " + request.output + ": that is the image's name; name the YAML file, such as " +
                                    std::filesystem::path(image).replace_extension(".yaml").string());
  }
  const auto map =
      exports::nav2_map(run, request.model, request.resolution, std::filesystem::path(image).filename().string());
  if (!map) {
    throw Failure(Exit::kUsage, fmt::format("a map of more than {:.0f} million cells; choose a larger --resolution",
                                            exports::kMaxCells / 1e6));
  }
  write_output(image, map->pgm);
  say(fmt::format("wrote {}: {} occupied, {} free, all others unknown", image, plural(map->occupied, "cell"),
                  map->free));
  return map->yaml;
}

constexpr std::array<Format, 9> kFormats = {{
    {"mcap", ".mcap", true, true, false,
     [](const exports::Run& run, const ExportRequest& request) {
       return exports::mcap_of(run, *exports::foxglove_json(), request.start);
     }},
    {"mcap-ros2", ".mcap", false, true, false,
     [](const exports::Run& run, const ExportRequest& request) {
       return exports::mcap_of(run, *exports::ros2_cdr(), request.start);
     }},
    {"nav2", ".yaml", true, false, false, write_nav2},
    {"collision-monitor", ".yaml", false, false, false,
     [](const exports::Run& run, const ExportRequest&) { return exports::collision_monitor(run); }},
    {"geojson", ".geojson", true, false, false,
     [](const exports::Run& run, const ExportRequest& request) {
       return exports::geojson_of(run, request.model, anchor_of(request));
     }},
    {"svg", ".svg", true, false, false,
     [](const exports::Run& run, const ExportRequest& request) {
       return exports::svg_of(exports::draw_run(run, request.model), run.name);
     }},
    {"png", ".png", true, false, true,
     [](const exports::Run& run, const ExportRequest& request) {
       return png_file(exports::draw_run(run, request.model), request.scale);
     }},
    {"glb", ".glb", true, false, false,
     [](const exports::Run& run, const ExportRequest& request) { return exports::glb_of(run, request.model); }},
    {"csv", ".csv", true, true, false,
     [](const exports::Run& run, const ExportRequest&) { return exports::csv_of(run); }},
}};

std::vector<std::string> format_names() {
  std::vector<std::string> names;
  for (const Format& format : kFormats) names.emplace_back(format.name);
  return names;
}

const Format& format_of(const ExportRequest& request) {
  const std::string ending = std::filesystem::path(request.output).extension().string();
  for (const Format& format : kFormats) {
    if (request.format.empty() ? format.by_ending && format.ending == ending : format.name == request.format) {
      return format;
    }
  }
  std::string endings;
  for (const Format& format : kFormats) {
    if (format.by_ending) endings += (endings.empty() ? "" : ", ") + std::string(format.ending);
  }
  throw Failure(Exit::kUsage,
                (request.output.empty() ? "no format was named" : request.output + ": its ending names no format") +
                    std::string("; choose one with --format, or a FILE that ends in ") + endings);
}

/// Reports objects that have no outline by the chosen model: a user would miss them on the map.
void say_missing(const exports::Run& run, const std::string& model) {
  if (model.empty()) return;
  std::size_t missing = 0;
  for (const ObjectResult& object : run.document.objects) {
    missing += exports::is_solid(object) && exports::outline_of(object, model) == nullptr ? 1U : 0U;
  }
  const std::vector<std::string> known = model_names(run.document);
  if (std::ranges::find(known, model) == known.end()) {
    std::string names;
    for (const std::string& name : known) names += (names.empty() ? "" : ", ") + name;
    throw Failure(Exit::kUsage, "--model " + model + ": this run has " + (names.empty() ? "no objects" : names));
  }
  if (missing > 0) say(fmt::format("{} of its objects have no outline by model {}", missing, model));
}

/// A long run for a map or a picture, read in portions.
ReplayOutcome replay_for_map(const LogSource& source, const ExportRequest& request, ReplayOptions options) {
  constexpr std::size_t kMaxAlerts = 20'000;
  AlertSpool alerts;
  options.alerts = &alerts;
  options.most_poses = kPosesToShow;
  ReplayOutcome outcome = replay(source, input_name(request.log), options);
  ThinnedAlerts kept = thin_alerts([&](const auto& visit) { alerts.each(visit); }, kMaxAlerts);
  outcome.result.alerts = std::move(kept.kept);
  if (kept.all > outcome.result.alerts.size()) {
    outcome.complaints.push_back(
        fmt::format("{} of {} alerts are in it: of those that follow each other fast the worst",
                    outcome.result.alerts.size(), kept.all));
  }
  return outcome;
}

/// `bytes` gets the log where the format has it inside: a run with its history is in memory as a whole.
exports::Run read_run(const ExportRequest& request, const Format& format, const std::string& name, std::string& bytes) {
  if (format.history) expect_whole_log(request.log);
  ReplayOptions options = request.options;
  exports::History history(request.interval, format.name != "csv");
  if (format.history) options.observer = &history;
  exports::RunInputs inputs(options, format.history);
  LogInput input(request.log);
  ReplayProgress progress(input);
  const LogSource source = [&] {
    const std::string_view part = progress.next();
    inputs.take(part);
    if (format.history) bytes += part;
    if (bytes.size() > kMaxWhole) refuse_long_log(request.log);
    return part;
  };
  ReplayOutcome outcome =
      format.history ? replay(source, input_name(request.log), options) : replay_for_map(source, request, options);
  if (outcome.unreadable) throw Failure(Exit::kUnreadable, outcome.unreadable->message);
  say_what_was_left_out(outcome);
  return exports::make_run(bytes, name, inputs, std::move(outcome), history);
}

Exit run(ExportRequest request) {
  if (request.log == "-" && request.camera == "-") {
    throw Failure(Exit::kUsage, "LOG and --camera cannot both be standard input; put one into a file");
  }
  if (request.options.from && request.options.to && *request.options.from > *request.options.to) {
    throw Failure(Exit::kUsage, "--from is later than --to; swap them");
  }
  if (!request.at.empty() && std::abs(request.at[0]) > 90) {
    throw Failure(Exit::kUsage, fmt::format("--at: {} is no latitude; it comes first, -90 to 90", request.at[0]));
  }
  const Format& format = format_of(request);
  if (format.lab) need_lab("export to PNG");
  const std::string stem = request.log == "-" ? "fencepost" : std::filesystem::path(request.log).stem().string();
  if (request.output.empty()) request.output = stem + std::string(format.ending);
  if (!request.camera.empty()) request.options.camera = read_camera(request.camera);

  const std::string name = request.log == "-" ? "run.log" : std::filesystem::path(request.log).filename().string();
  std::string bytes;
  const exports::Run made = read_run(request, format, name, bytes);
  say_missing(made, request.model);
  write_output(request.output, format.write(made, request));
  if (!is_standard_output(request.output)) say("wrote " + request.output);
  return Exit::kDone;
}

Action configure_export(Options command) {
  const auto request = std::make_shared<ExportRequest>();
  command.positional("LOG", request->log, "a recorded stream; - is standard input").required();
  command.value("--format", request->format, "what to write; default: by FILE's ending").one_of(format_names());
  command.value("-o,--output", request->output, "default: the log's name with the format's ending, in this folder")
      .takes("FILE");
  command
      .value("--model", request->model,
             "outlines of that model alone; default: the hybrid's, where there is none the cylinder's")
      .takes("NAME");
  command.value("--every", request->interval, "s, mcap and csv: an object at most so often; default 0.2")
      .takes("S")
      .not_negative();
  command.value("--start", request->start, "mcap: s since 1970 at the run's beginning; default 0")
      .takes("T")
      .within(0.0, 1e10);
  command.value("--resolution", request->resolution, "nav2: m a cell; default 0.02").takes("M").positive();
  command.value("--at", request->at, "geojson: the map's origin in degrees, and its x axis from north; default: metres")
      .takes("LAT,LON[,BEARING]")
      .separated_by(',')
      .count(2, 3)
      .within(-360.0, 360.0);
  command.value("--scale", request->scale, "png: pixels for one of the SVG's; default 2").takes("F").within(0.1, 8.0);
  command.profile(request->options.profile);
  command.log_camera(request->camera);
  command.value("--from", request->options.from, "s, stream time; earlier records are not used").takes("T");
  command.value("--to", request->options.to, "s, stream time; later records are not used").takes("T");
  return [request] { return run(*request); };
}

}  // namespace

Command export_command() {
  return {"export",
          "a run for other programs: Foxglove, ROS 2, maps, pictures, tables",
          "  fencepost export run.log -o run.mcap\n"
          "  fencepost export run.log --format mcap-ros2 --start 1767225600\n"
          "  fencepost export run.log --format nav2 -o map.yaml\n"
          "  fencepost export run.log -o run.glb\n",
          configure_export,
          {}};
}

}  // namespace fencepost::host::cli
