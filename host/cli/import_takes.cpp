#include "host/cli/import_takes.hpp"

#include <filesystem>
#include <memory>

#include "host/cli/files.hpp"
#include "host/cli/live_devices.hpp"
#include "host/cli/replay_run.hpp"
#include "host/devices/catalogue.hpp"
#include "host/devices/open_devices.hpp"
#include "host/import/candump/candump.hpp"
#include "host/import/csv/csv.hpp"
#include "host/import/mcap/mcap.hpp"
#include "host/import/player/player.hpp"
#include "host/import/sketch/sketch.hpp"
#include "host/import/wpilog/wpilog.hpp"
#include "host/text/suggest.hpp"

namespace fencepost::host::cli {
namespace {

/// Bytes of a recording of others that is no table: an hour of a busy CAN bus has 300 MB.
constexpr std::size_t kMaxRecording = 1'000'000'000;

struct TakeRequest {
  std::string source;
  std::string camera;
  std::string poses;
  std::string robot;
  std::string blobs;
  double rate = TakeSettings().rate;
  McapTopics topics;
  std::string output = "-";
};

/// A file, or a camera of the catalogue as its maker describes it.
sensor::CameraIntrinsics camera_named(const std::string& name) {
  std::vector<std::string> known;
  for (const devices::Row* row : devices::rows_for(devices::Use::kCamera)) {
    known.emplace_back(*row->name);
    if (known.back() != name) continue;
    if (const auto camera = devices::nominal_camera(*row)) return *camera;
  }
  if (const std::string guess = did_you_mean(name, known); !guess.empty() && !std::filesystem::exists(name)) {
    throw Failure(Exit::kUnreadable, "--camera: there is neither a camera nor a file " + name + ";" + guess);
  }
  return read_camera(name);
}

TakeSettings settings_of(const TakeRequest& request) {
  TakeSettings settings;
  settings.rate = request.rate;
  if (!request.camera.empty()) settings.camera = camera_named(request.camera);
  try {
    if (!request.poses.empty()) settings.poses = parse_pose_table(read_input(request.poses), input_name(request.poses));
  } catch (const ImportError& error) {
    throw Failure(Exit::kUnreadable, error.message());
  }
  return settings;
}

Exit import_can(const TakeRequest& request) {
  const RobotFile robot = read_robot(request.robot);
  if (!robot.can) {
    throw Failure(
        Exit::kUnreadable,
        request.robot + ": has no \"can\", which says where the wheels' numbers stand; share/doc/live.md shows it");
  }
  try {
    return finish_import(
        import_candump(read_input(request.source, kMaxRecording), input_name(request.source), *robot.can,
                       take_csv(read_input(request.blobs), input_name(request.blobs)), settings_of(request)),
        request.output);
  } catch (const ImportError& error) {
    throw Failure(Exit::kUnreadable, error.message());
  }
}

void add_common(Options command, TakeRequest& request, const char* source, const char* about) {
  command.positional(source, request.source, about).required();
  command
      .value("--camera", request.camera,
             "how the camera sees: a name such as pixy2, or a file with an FPCAM line, a scene, or its \"camera\"")
      .takes("NAME|FILE");
  command.value("-o,--output", request.output, "where to write the log; default: standard output").takes("LOG");
}

void add_poses(Options command, TakeRequest& request) {
  command.value("--poses", request.poses, "the robot's poses: CSV t,x,y,heading (s, m, rad), or TUM's eight numbers")
      .takes("FILE");
}

template <class Import>
Action with(Options command, const std::shared_ptr<TakeRequest>& request, const char* source, const char* about,
            Import import, std::size_t most = kMaxWhole) {
  add_common(command, *request, source, about);
  add_poses(command, *request);
  return [request, import, most] {
    return finish_import(import(read_input(request->source, most), input_name(request->source), settings_of(*request)),
                         request->output);
  };
}

Action configure_csv(Options command) {
  return with(command, std::make_shared<TakeRequest>(), "CSV", "blobs, by the names of their columns",
              [](const auto&... arguments) { return import_csv(arguments...); });
}

Action configure_sketch(Options command) {
  const auto request = std::make_shared<TakeRequest>();
  command.value("--rate", request->rate, "frames a second, 0.1 to 1000, where the text has no times; default 20")
      .takes("HZ")
      .within(0.1, 1000.0);
  return with(command, request, "TEXT", "what the monitor of the Arduino IDE showed, saved",
              [](const auto&... arguments) { return import_sketch(arguments...); });
}

Action configure_player(Options command) {
  return with(command, std::make_shared<TakeRequest>(), "LOG", "of Player's writelog: position2d and blobfinder",
              [](const auto&... arguments) { return import_player(arguments...); });
}

Action configure_mcap(Options command) {
  const auto request = std::make_shared<TakeRequest>();
  command.value("--detections", request->topics.detections, "the topic; default: the first of its kind").takes("TOPIC");
  command.value("--odometry", request->topics.odometry, "likewise").takes("TOPIC");
  return with(
      command, request, "MCAP", "Detection2DArray and Odometry, as CDR or JSON",
      [request](const auto& bytes, const auto& file, const auto& settings) {
        return import_mcap(bytes, file, request->topics, settings);
      },
      kMaxRecording);
}

Action configure_wpilog(Options command) {
  struct WpilogRequest : TakeRequest {
    WpilogTopics entries;
  };
  const auto request = std::make_shared<WpilogRequest>();
  command.value("--detections", request->entries.detections, "the entry; default: the one that says most")
      .takes("ENTRY");
  command.value("--odometry", request->entries.odometry, "likewise").takes("ENTRY");
  return with(
      command, request, "WPILOG", "of a robot with WPILib: PhotonVision or a Limelight, and odometry",
      [request](const auto& bytes, const auto& file, const auto& settings) {
        return import_wpilog(bytes, file, request->entries, settings);
      },
      kMaxRecording);
}

Action configure_candump(Options command) {
  const auto request = std::make_shared<TakeRequest>();
  add_common(command, *request, "LOG", "of candump -l, or its output with -t a");
  command.value("--robot", request->robot, "the robot file with the mapping \"can\"").required().takes("FILE");
  command.value("--blobs", request->blobs, "CSV as of import csv, by the same clock").required().takes("CSV");
  return [request] { return import_can(*request); };
}

}  // namespace

std::vector<Command> take_commands() {
  return {{"csv",
           "blobs and poses, by the names of their columns",
           "  fencepost import csv blobs.csv --poses poses.csv --camera camera.json -o run.log\n",
           configure_csv,
           {}},
          {"sketch",
           "what the Arduino examples of Pixy, HuskyLens and CMUcam print",
           "  fencepost import sketch monitor.txt --camera pixy2 --poses poses.csv -o run.log\n",
           configure_sketch,
           {}},
          {"player",
           "logs of Player's writelog",
           "  fencepost import player run.player --camera camera.json -o run.log\n",
           configure_player,
           {}},
          {"candump",
           "wheels on CAN, beside a table of blobs",
           "  fencepost import candump can.log --robot robot.json --blobs blobs.csv --camera pixy2 -o run.log\n",
           configure_candump,
           {}},
          {"mcap",
           "detections and odometry of ROS 2",
           "  fencepost import mcap run.mcap --camera camera.json -o run.log\n",
           configure_mcap,
           {}},
          {"wpilog",
           "targets of PhotonVision or a Limelight, and odometry, of WPILib",
           "  fencepost import wpilog FRC_20260314.wpilog --camera camera.json -o run.log\n",
           configure_wpilog,
           {}}};
}

}  // namespace fencepost::host::cli
