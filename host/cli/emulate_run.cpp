#include "host/cli/emulate_run.hpp"

#include <fmt/format.h>

#include <cmath>
#include <csignal>
#include <cstdio>
#include <map>

#include "hal/linux/wait.hpp"
#include "host/cli/files.hpp"
#include "host/cli/log_input.hpp"
#include "host/cli/replay_run.hpp"
#include "host/cli/terminal.hpp"
#include "host/devices/emulated.hpp"
#include "host/devices/open_devices.hpp"
#include "host/emulate/scene/server.hpp"
#include "host/live/record_line.hpp"
#include "host/scene/load.hpp"
#include "host/text/plural.hpp"

namespace fencepost::host::cli {
namespace {

namespace emulate = fencepost::emulate;
using devices::DeviceSpec;
using emulate::Feed;

volatile std::sig_atomic_t interrupted = 0;
extern "C" void note_interrupt(int signal) { interrupted = signal; }

/// Ctrl-C too ends with links removed and counts printed.
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
  std::optional<emulate::ImageLimits> image;
};

[[noreturn]] void fail_usage(const std::string& message) {
  throw Failure(Exit::kUsage, message + "; see fencepost emulate --help");
}

DeviceSpec spec_of(const std::string& word) {
  const auto spec = devices::parse_device(word, devices::Use::kEmulated);
  if (!spec.ok()) fail_usage(spec.error());
  return *spec;
}

std::vector<Device> devices_of(const EmulateRequest& request) {
  if (request.words.size() < 2) fail_usage("a device and a scene or log are needed, such as pixy2 scene.json");
  std::vector<Device> devices;
  std::map<std::string, int> same;
  for (std::size_t i = 0; i + 1 < request.words.size(); ++i) {
    const DeviceSpec spec = spec_of(request.words[i]);
    const std::string kind = devices::label_of_emulated(spec);
    const int number = ++same[kind];
    devices.push_back(
        {number == 1 ? kind : fmt::format("{}#{}", kind, number), spec, {}, devices::emulated(spec).image});
    if (request.baud && spec.number("baud") > 0) devices.back().spec.options["baud"] = std::to_string(*request.baud);
  }
  return devices;
}

/// `--link` and `--listen`, each in order, for devices that have no place of their own.
void place(std::vector<Device>& devices, const EmulateRequest& request) {
  auto link = request.links.begin();
  auto listen = request.listens.begin();
  for (Device& device : devices) {
    DeviceSpec& spec = device.spec;
    if (spec.place.kind != PlaceKind::kTty || !spec.place.name.empty()) continue;
    if (link != request.links.end()) {
      spec.place.name = *link++;
    } else if (listen != request.listens.end()) {
      spec.place = {PlaceKind::kTcp, *listen++};
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
  const std::string bytes = read_log_or_scene(path);
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

void check_boxes(const Device& device, const Feed& feed) {
  const emulate::ImageLimits& image = *device.image;
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

/// Reports how the camera shows the feed differently from its records.
void explain_camera(const Device& device, const Feed& feed) {
  const emulate::ImageLimits& image = *device.image;
  if (feed.frames.empty()) {
    throw Failure(Exit::kUnreadable, device.name + ": no frame ($FPFRM) to show; give a log with frames, or a scene");
  }
  if (!feed.camera) return check_boxes(device, feed);
  const sensor::CameraIntrinsics& camera = *feed.camera;
  const auto nominal = devices::nominal_camera(*device.spec.row);
  if (camera.width != image.width || camera.height != image.height) {
    say(fmt::format("{}: boxes of {} x {} pixels are scaled to its {} x {}; the calibration that belongs to them:",
                    device.name, camera.width, camera.height, image.width, image.height));
    say(record_line_without_end(emulate::fitted_calibration(camera, image, devices::label_of_emulated(device.spec))));
  } else if (nominal && std::abs(camera.fx.to_double() / nominal->fx.to_double() - 1) > 0.05) {
    say(fmt::format("{}: focal length {} px, a usual one has {}; use the scene's calibration, not the driver's",
                    device.name, camera.fx.to_double(), nominal->fx.to_double()));
  }
}

void explain_wheels(const Device& device, const Feed& feed, const emulate::TravelLog& travel) {
  if (feed.poses.empty()) {
    throw Failure(Exit::kUnreadable, device.name + ": no pose ($FPODO) to drive along; give a log with odometry");
  }
  const emulate::WheelShape wheels = devices::wheels_of(device.spec);
  if (wheels.tick <= 0) return;
  say(fmt::format("{}: {:.7f} m a count, {} m between the wheels", device.name, wheels.tick, wheels.track));
  constexpr double kNoticeable = 0.02;
  if (travel.sideways() < kNoticeable) return;
  say(fmt::format(
      "{}: the path goes {:.2f} m sideways, which no wheel can tell: the pose will be off; turn the path or "
      "the camera's mount, or use records",
      device.name, travel.sideways()));
}

void explain(const std::vector<Device>& devices, const emulate::Playback& playback) {
  for (const Device& device : devices) {
    if (device.image) explain_camera(device, playback.feed());
    if (*device.spec.row->role == devices::Role::kOdometry) explain_wheels(device, playback.feed(), playback.travel());
  }
}

emulate::PlaybackSettings playback_settings(const EmulateRequest& request, const std::vector<Device>& devices) {
  const auto duration = [](const std::optional<double>& seconds) {
    return seconds ? std::optional(base::Duration::nearest(*seconds)) : std::nullopt;
  };
  emulate::PlaybackSettings settings{request.speed, duration(request.delay), request.loop, duration(request.seconds)};
  bool can_only = true;
  for (const Device& device : devices) can_only = can_only && device.spec.place.kind == PlaceKind::kCan;
  // There no host is ever seen.
  if (can_only && !settings.delay) settings.delay = base::milliseconds(1'000);
  return settings;
}

void say_counts(const emulate::Endpoint& endpoint) {
  const emulate::EndpointCounts& counts = endpoint.counts();
  std::string line = fmt::format("{}: {} heard, {}", endpoint.name(), plural(counts.commands, "byte"),
                                 plural(counts.replies, "reply", "replies"));
  if (endpoint.fit()) line += fmt::format(", {} seen, {} skipped", plural(counts.frames, "frame"), counts.skipped);
  say(line);
  if (const std::vector<std::string> names = endpoint.not_emulated(); !names.empty()) {
    say(fmt::format("  {} not emulated: {}", names.size(), fmt::join(names, ", ")));
  }
  if (endpoint.fit()) {
    const emulate::FitLosses& losses = endpoint.fit()->losses();
    if (losses.signatures > 0)
      say(fmt::format("  {} of signatures that it does not have", plural(losses.signatures, "blob")));
    if (losses.blobs > 0) say(fmt::format("  {} more than it can tell", plural(losses.blobs, "blob")));
    if (losses.outside > 0) say(fmt::format("  {} outside the image", plural(losses.outside, "box", "boxes")));
  }
  const emulate::FaultCounts& faults = endpoint.faults();
  if (faults.dropped + faults.corrupted + faults.stalled + faults.late + faults.reboots + faults.unplugs == 0) return;
  say(fmt::format("  faults: of {} {} dropped, {} corrupted; of {} {} late, {}; {}, {}", plural(faults.bytes, "byte"),
                  faults.dropped, faults.corrupted, plural(faults.said, "reply", "replies"), faults.late,
                  plural(faults.stalled, "stall"), plural(faults.reboots, "reboot"), plural(faults.unplugs, "unplug")));
}

}  // namespace

Exit emulate(const EmulateRequest& request) {
  std::vector<Device> devices = devices_of(request);
  place(devices, request);
  set_faults(devices, request);
  Feed feed = read_feed(request);
  const emulate::Say tell_people = [](const std::string& line) { say(line); };
  const linux::MonotonicClock clock;
  emulate::Playback playback(std::move(feed), playback_settings(request, devices), clock.now());
  explain(devices, playback);
  emulate::Server server(playback, clock, tell_people, tell);
  std::uint64_t seed = request.seed * 1'000;
  catch_interrupts();  // before there is a link that would stay
  for (const Device& device : devices) {
    emulate::OpenedTransport transport = devices::open_transport(device.spec);
    if (!transport) throw Failure(Exit::kDevice, device.name + ": " + transport.problem());
    playback.add({device.name, devices::emulated(device.spec), device.faults, seed++,
                  request.verbose ? tell_people : emulate::Say()});
    server.add(std::move(*transport));
  }
  for (std::size_t i = 0; i < devices.size(); ++i) tell(devices[i].name + " on " + server.place(i));
  const bool finished = server.run([] { return interrupted != 0; });
  if (interrupted == SIGINT) leave_interrupted_line();
  if (server.late() >= linux::kNotedDelay) {
    say(fmt::format("this machine was busy: the devices were up to {:.0f} ms late, as real ones are not",
                    1000 * server.late().to_double()));
  }
  for (std::size_t i = 0; i < playback.size(); ++i) say_counts(playback.endpoint(i));
  // As for `run`: a service that is stopped on request has done its work.
  return finished || interrupted == SIGTERM ? Exit::kDone : Exit::kInterrupted;
}

}  // namespace fencepost::host::cli
