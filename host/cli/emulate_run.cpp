#include "host/cli/emulate_run.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <map>

#include "firmware/record/encode.hpp"
#include "host/cli/files.hpp"
#include "host/cli/replay_run.hpp"
#include "host/cli/terminal.hpp"
#include "host/emulate/transport/server.hpp"
#include "host/scene/load.hpp"

namespace fencepost::host::cli {
namespace {

namespace emulate = fencepost::emulate;
using emulate::DeviceKind;
using emulate::DeviceSpec;
using emulate::Feed;

volatile std::sig_atomic_t interrupted = 0;
extern "C" void note_interrupt(int signal) { interrupted = signal; }

/// Links are removed and counts told also at Ctrl-C.
void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = note_interrupt;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) ::sigaction(signal, &action, nullptr);
}

void tell(const std::string& line) {
  std::fwrite(line.data(), 1, line.size(), stdout);
  std::fputc('\n', stdout);
  std::fflush(stdout);
}

struct Device {
  std::string name;
  DeviceSpec spec;
  emulate::FaultSettings faults;
};

[[noreturn]] void fail_usage(const std::string& message) {
  throw Failure(Exit::kUsage, message + "; see fencepost emulate --help");
}

DeviceSpec spec_of(const std::string& word) {
  const emulate::ParsedDevice parsed = emulate::parse_device(word);
  if (parsed.problem.empty()) return parsed.spec;
  fail_usage(parsed.problem);
}

std::vector<Device> devices_of(const EmulateRequest& request) {
  if (request.words.size() < 2) fail_usage("a device and a scene or log are needed, such as pixy2 scene.json");
  std::vector<Device> devices;
  std::map<std::string, int> same;
  for (std::size_t i = 0; i + 1 < request.words.size(); ++i) {
    const DeviceSpec spec = spec_of(request.words[i]);
    const std::string kind(spec.kind->name);
    const int number = ++same[kind];
    devices.push_back({number == 1 ? kind : fmt::format("{}#{}", kind, number), spec, {}});
    if (request.baud && spec.kind->baud > 0) devices.back().spec.baud = *request.baud;
  }
  return devices;
}

/// `--link` and `--listen`, each in order, for devices that have no place of their own.
void place(std::vector<Device>& devices, const EmulateRequest& request) {
  auto link = request.links.begin();
  auto listen = request.listens.begin();
  for (Device& device : devices) {
    DeviceSpec& spec = device.spec;
    if (spec.place != DeviceSpec::Place::kPty || !spec.where.empty()) continue;
    if (link != request.links.end()) {
      spec.where = *link++;
    } else if (listen != request.listens.end()) {
      spec.place = DeviceSpec::Place::kTcp;
      spec.where = *listen++;
    }
  }
  if (link != request.links.end()) fail_usage("--link " + *link + " has no device: there are more links than devices");
  if (listen != request.listens.end()) fail_usage("--listen " + *listen + " has no device");
}

void set_faults(std::vector<Device>& devices, const EmulateRequest& request) {
  for (const std::string& text : request.faults) {
    const std::size_t colon = text.find(':');
    const bool named = colon != std::string::npos && colon < text.find('=');
    bool found = !named;
    for (Device& device : devices) {
      if (named && device.name != text.substr(0, colon)) continue;
      const emulate::ParsedFaults parsed = emulate::parse_faults(named ? text.substr(colon + 1) : text, device.faults);
      if (!parsed.problem.empty()) fail_usage(parsed.problem);
      device.faults = parsed.settings;
      found = true;
    }
    if (!found) fail_usage(fmt::format("--fault {}: no device {} here", text, text.substr(0, colon)));
  }
}

Feed read_feed(const EmulateRequest& request) {
  const std::string& path = request.words.back();
  const std::string name = input_name(path);
  const std::string bytes = read_input(path);
  const std::size_t start = bytes.find_first_not_of(" \t\r\n");
  Feed feed;
  if (start != std::string::npos && bytes[start] == '{') {
    const LoadedScene scene = parse_scene(bytes, name);
    if (!scene.ok()) throw Failure(Exit::kUnreadable, scene.error().message());
    feed = emulate::feed_from_scene(*scene);
    if (!feed.problem.empty()) feed.problem = name + ": " + feed.problem;
  } else {
    feed = emulate::feed_from_log(bytes, name);
  }
  if (!feed.problem.empty()) throw Failure(Exit::kUnreadable, feed.problem);
  if (!request.camera.empty()) feed.camera = read_camera(request.camera);
  for (const std::string& note : feed.notes) say(note);
  return feed;
}

std::string camera_line(const sensor::CameraIntrinsics& camera) {
  std::array<char, record::kMaxLine> buffer{};
  const std::size_t size = record::encode(camera, buffer);
  return {buffer.data(), size < 2 ? 0 : size - 2};
}

void check_boxes(const Device& device, const Feed& feed) {
  const emulate::ImageLimits& image = *device.spec.kind->image;
  for (const sensor::BlobFrame& frame : feed.frames) {
    for (const sensor::Blob& blob : frame.blobs) {
      if (blob.x1 >= 0 && blob.y1 >= 0 && blob.x2 < image.width && blob.y2 < image.height) continue;
      throw Failure(Exit::kUnreadable,
                    fmt::format("{}: a box reaches column {}, row {}, the image has {} x {}; the log has no FPCAM: say "
                                "with --camera which camera its boxes are of",
                                device.name, blob.x2, blob.y2, image.width, image.height));
    }
  }
}

/// What of the feed the camera shows otherwise than it stands there.
void explain_camera(const Device& device, const Feed& feed) {
  const DeviceKind& kind = *device.spec.kind;
  if (feed.frames.empty()) {
    throw Failure(Exit::kUnreadable, device.name + ": no frame ($FPFRM) to show; give a log with frames, or a scene");
  }
  if (!feed.camera) return check_boxes(device, feed);
  const sensor::CameraIntrinsics& camera = *feed.camera;
  if (camera.width != kind.image->width || camera.height != kind.image->height) {
    say(fmt::format("{}: boxes of {} x {} pixels are scaled to its {} x {}; the calibration that belongs to them:",
                    device.name, camera.width, camera.height, kind.image->width, kind.image->height));
    say(camera_line(emulate::fitted_calibration(camera, *kind.image, kind.name)));
  } else if (kind.focal > 0 && std::abs(camera.fx.to_double() / kind.focal - 1) > 0.05) {
    say(fmt::format("{}: focal length {} px, a usual one has {}; use the scene's calibration, not the driver's",
                    device.name, camera.fx.to_double(), kind.focal));
  }
}

void explain_wheels(const Device& device, const Feed& feed, const emulate::TravelLog& travel) {
  if (feed.poses.empty()) {
    throw Failure(Exit::kUnreadable, device.name + ": no pose ($FPODO) to drive along; give a log with odometry");
  }
  const DeviceSpec& spec = device.spec;
  if (spec.wheels.tick <= 0) return;
  say(fmt::format("{}: {:.7f} m a count, {} m between the wheels", device.name, spec.wheels.tick, spec.wheels.track));
  constexpr double kNoticeable = 0.02;
  if (travel.sideways() < kNoticeable) return;
  say(fmt::format(
      "{}: the path goes {:.2f} m sideways, which no wheel can tell: the pose will be off; turn the path or "
      "the camera's mount, or use records",
      device.name, travel.sideways()));
}

void explain(const std::vector<Device>& devices, const emulate::Stage& stage) {
  for (const Device& device : devices) {
    const bool brick_alone = device.spec.kind->speech == emulate::Speech::kNxt && !device.spec.camera_port;
    if (device.spec.kind->image && !brick_alone) explain_camera(device, stage.feed());
    const bool camera_alone = device.spec.kind->image && device.spec.kind->speech != emulate::Speech::kNxt;
    if (!camera_alone) explain_wheels(device, stage.feed(), stage.travel());
  }
}

emulate::OpenedEndpoint open_endpoint(const DeviceSpec& spec) {
  switch (spec.place) {
    case DeviceSpec::Place::kPty: break;
    case DeviceSpec::Place::kTcp: return emulate::open_tcp(spec.where);
    case DeviceSpec::Place::kCan: return emulate::open_can(spec.where);
  }
  return emulate::open_pty(spec.where);
}

emulate::StageSettings stage_settings(const EmulateRequest& request, const std::vector<Device>& devices) {
  const auto duration = [](const std::optional<double>& seconds) {
    return seconds ? std::optional(base::Duration::nearest(*seconds)) : std::nullopt;
  };
  emulate::StageSettings settings{request.speed, duration(request.delay), request.loop, duration(request.seconds)};
  bool can_only = true;
  for (const Device& device : devices) can_only = can_only && device.spec.place == DeviceSpec::Place::kCan;
  // There no host is ever seen.
  if (can_only && !settings.delay) settings.delay = base::milliseconds(1'000);
  return settings;
}

void say_counts(const emulate::Station& station) {
  const emulate::StationCounts& counts = station.counts();
  std::string line = fmt::format("{}: {} bytes heard, {} replies", station.name(), counts.commands, counts.replies);
  if (station.fit()) line += fmt::format(", {} frames seen, {} skipped", counts.frames, counts.skipped);
  say(line);
  if (station.fit()) {
    const emulate::FitLosses& losses = station.fit()->losses();
    if (losses.signatures > 0) say(fmt::format("  {} blobs of signatures that it does not have", losses.signatures));
    if (losses.blobs > 0) say(fmt::format("  {} blobs more than it can tell", losses.blobs));
    if (losses.outside > 0) say(fmt::format("  {} boxes outside the image", losses.outside));
  }
  const emulate::FaultCounts& faults = station.faults();
  if (faults.dropped + faults.corrupted + faults.stalled + faults.late + faults.reboots + faults.unplugs == 0) return;
  say(
      fmt::format("  faults: of {} bytes {} dropped, {} corrupted; of {} replies {} late, {} stalls; {} reboots, {} "
                  "unplugs",
                  faults.bytes, faults.dropped, faults.corrupted, faults.said, faults.late, faults.stalled,
                  faults.reboots, faults.unplugs));
}

}  // namespace

Exit emulate(const EmulateRequest& request) {
  std::vector<Device> devices = devices_of(request);
  place(devices, request);
  set_faults(devices, request);
  Feed feed = read_feed(request);
  const emulate::Say tell_people = [](const std::string& line) { say(line); };
  const linux::MonotonicClock clock;
  emulate::Stage stage(std::move(feed), stage_settings(request, devices), clock.now());
  explain(devices, stage);
  emulate::Server server(stage, clock, tell_people, tell);
  std::uint64_t seed = request.seed * 1'000;
  for (const Device& device : devices) {
    emulate::OpenedEndpoint endpoint = open_endpoint(device.spec);
    if (!endpoint) throw Failure(Exit::kDevice, device.name + ": " + endpoint.problem());
    stage.add({device.name, device.spec, device.faults, seed++, request.verbose ? tell_people : emulate::Say()});
    server.add(std::move(*endpoint));
  }
  catch_interrupts();
  for (std::size_t i = 0; i < devices.size(); ++i) tell(devices[i].name + " on " + server.place(i));
  const bool finished = server.run([] { return interrupted != 0; });
  if (interrupted == SIGINT) leave_interrupted_line();
  for (std::size_t i = 0; i < stage.size(); ++i) say_counts(stage.station(i));
  // As for `run`: a service that is told to stop has done its work.
  return finished || interrupted == SIGTERM ? Exit::kDone : Exit::kInterrupted;
}

}  // namespace fencepost::host::cli
