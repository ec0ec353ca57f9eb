#include "host/export/mcap/mcap.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "firmware/console/text.hpp"
#include "host/report/palette.hpp"
#include "host/result/lookup.hpp"

namespace fencepost::host::exports {
namespace {

constexpr double kNanoseconds = 1e9;
constexpr double kFollows = 0.5;  ///< s; poses farther apart give no speed

/// A message that is made when it is written: made, a long run's would fill memory.
struct Waiting {
  double t;
  Topic topic;
  std::size_t index;  ///< of a pose, a frame, a change or an alert
};

class Recording {
 public:
  Recording(const Run& run, const Encoding& encoding, double start) : run_(run), encoding_(encoding), start_(start) {}

  std::string bytes() {
    add_camera();
    add_poses();
    add_detections();
    add_history();
    add_end();
    add_alerts();
    std::ranges::stable_sort(waiting_, {}, &Waiting::t);
    return written();
  }

 private:
  [[nodiscard]] bool told(Topic topic) const { return encoding_.channel(topic).has_value(); }
  void add(double t, Topic topic, std::size_t index) { waiting_.push_back({t, topic, index}); }
  [[nodiscard]] double stamp(double t) const { return start_ + t; }

  void add_camera() {
    if (!run_.document.camera || run_.document.path.empty()) return;
    add(run_.document.path.front().t, Topic::kStaticTransforms, 0);
  }

  void add_poses() {
    const std::vector<PoseResult>& path = run_.document.path;
    for (std::size_t i = 0; i < path.size(); ++i) {
      add(path[i].t, Topic::kTransforms, i);
      if (told(Topic::kPose)) add(path[i].t, Topic::kPose, i);
      add(path[i].t, Topic::kOdometry, i);
    }
  }

  static Moving moving(const PoseResult* before, const PoseResult& now) {
    Moving moving{now};
    const double dt = before != nullptr ? now.t - before->t : 0;
    if (dt <= 0 || dt > kFollows) return moving;
    const double dx = (now.x - before->x) / dt;
    const double dy = (now.y - before->y) / dt;
    const double c = std::cos(now.heading);
    const double s = std::sin(now.heading);
    moving.forward = c * dx + s * dy;
    moving.left = c * dy - s * dx;
    const double turn = now.heading - before->heading;
    moving.turning = std::atan2(std::sin(turn), std::cos(turn)) / dt;
    return moving;
  }

  void add_detections() {
    for (std::size_t i = 0; i < run_.frames.size(); ++i) add(run_.frames[i].t.to_double(), Topic::kDetections, i);
  }

  void show(SceneChange& change, const ObjectResult& object) {
    const ModelResult* outline = outline_of(object, "");
    if (outline == nullptr) return;
    shown_.insert(object.id);
    change.shown.push_back(
        {object, *outline, title_of(run_.document, object), signature_colour(run_.document, object.signature)});
  }
  void add(SceneChange change) {
    if (change.shown.empty() && change.gone.empty()) return;
    add(change.t, Topic::kObjects, changes_.size());
    change.t = stamp(change.t);
    changes_.push_back(std::move(change));
  }

  /// Objects that were seen in the same frame are one change.
  void add_history() {
    SceneChange change;
    for (const ObjectAt& at : run_.history) {
      if (at.t != change.t) {
        add(std::move(change));
        change = {at.t, {}, {}};
      }
      show(change, at.object);
    }
    add(std::move(change));
  }

  /// The map's objects at the end, and the removal of those that it has no more.
  void add_end() {
    if (run_.document.path.empty()) return;
    SceneChange change;
    change.t = run_.document.path.back().t;
    if (!run_.frames.empty()) change.t = std::max(change.t, run_.frames.back().t.to_double());
    std::set<std::uint32_t> gone = shown_;
    for (const ObjectResult& object : run_.document.objects) {
      show(change, object);
      gone.erase(object.id);
    }
    change.gone.assign(gone.begin(), gone.end());
    add(std::move(change));
  }

  void add_alerts() {
    const std::vector<record::AlertReport>& alerts = run_.document.alerts;
    for (std::size_t i = 0; i < alerts.size(); ++i) add(alerts[i].t.to_double(), Topic::kAlerts, i);
  }

  [[nodiscard]] std::string camera_transform() const {
    const sensor::CameraMount& mount = run_.document.camera->mount;
    const double pitch = mount.pitch ? mount.pitch->to_double() : 0;
    const std::array placement = {Placement{kRobotFrame, kCameraFrame, mount.x.to_double(), mount.y.to_double(),
                                            mount.z.to_double(), Turn::of(mount.yaw.to_double(), pitch)}};
    return encoding_.transforms(stamp(run_.document.path.front().t), placement);
  }
  [[nodiscard]] std::string robot_transform(const PoseResult& pose) const {
    const std::array placement = {Placement{kMapFrame, kRobotFrame, pose.x, pose.y, 0, Turn::of(pose.heading)}};
    return encoding_.transforms(stamp(pose.t), placement);
  }
  [[nodiscard]] std::string alert(const record::AlertReport& alert) const {
    const record::Signature* known = find_signature(run_.document, alert.signature);
    std::array<char, console::kMaxSentence> sentence{};
    const std::size_t size =
        console::describe(alert, known != nullptr ? known->name.view() : std::string_view(), sentence);
    return encoding_.alert(stamp(alert.t.to_double()), alert.level, {sentence.data(), size < 2 ? 0 : size - 2});
  }

  [[nodiscard]] std::string message(const Waiting& one) const {
    const std::vector<PoseResult>& path = run_.document.path;
    const std::size_t i = one.index;
    switch (one.topic) {
      case Topic::kTransforms: return robot_transform(path[i]);
      case Topic::kStaticTransforms: return camera_transform();
      case Topic::kPose: return encoding_.pose(stamp(path[i].t), path[i]);
      case Topic::kOdometry:
        return encoding_.odometry(stamp(path[i].t), moving(i > 0 ? &path[i - 1] : nullptr, path[i]));
      case Topic::kDetections: {
        const double latency = run_.document.camera ? run_.document.camera->latency.to_double() : 0;
        return encoding_.detections(stamp(one.t - latency), run_, run_.frames[i]);
      }
      case Topic::kObjects: return encoding_.objects(changes_[i]);
      case Topic::kAlerts: return alert(run_.document.alerts[i]);
    }
    return {};
  }

  std::string written() const {
    McapWriter writer(encoding_.profile(), "fencepost", encoding_.message_encoding());
    std::array<std::uint16_t, kTopics> channels{};
    for (std::size_t i = 0; i < kTopics; ++i) {
      const auto channel = encoding_.channel(static_cast<Topic>(i));
      if (channel) channels[i] = writer.add_channel(channel->topic, channel->schema, channel->metadata);
    }
    // Without a topic of its own.
    constexpr auto kStatic = static_cast<std::size_t>(Topic::kStaticTransforms);
    if (channels[kStatic] == 0) channels[kStatic] = channels[static_cast<std::size_t>(Topic::kTransforms)];
    const auto nanoseconds = [this](double t) {
      return static_cast<std::uint64_t>(std::llround(std::max(0.0, stamp(t)) * kNanoseconds));
    };
    for (const Waiting& one : waiting_) {
      writer.write(channels[static_cast<std::size_t>(one.topic)], nanoseconds(one.t), message(one));
    }
    const double end = waiting_.empty() ? 0 : waiting_.back().t;
    writer.attach(run_.name, "text/plain", nanoseconds(end), run_.log);
    writer.add_metadata("fencepost", {{"digest", digest_text(run_.document.digest)},
                                      {"profile", run_.document.profile},
                                      {"lengths", "m, map frame: x forward at the start, y left, z up"}});
    encoding_.add_metadata(writer);
    return writer.finish();
  }

  const Run& run_;
  const Encoding& encoding_;
  double start_;
  std::vector<Waiting> waiting_;
  std::vector<SceneChange> changes_;
  std::set<std::uint32_t> shown_;
};

}  // namespace

Turn Turn::of(double yaw, double pitch) {
  const double cy = std::cos(yaw / 2);
  const double sy = std::sin(yaw / 2);
  const double cp = std::cos(pitch / 2);
  const double sp = std::sin(pitch / 2);
  return {-sy * sp, cy * sp, sy * cp, cy * cp};
}

Stamp::Stamp(double t) {
  // Rounded to tenths of a millisecond, the robot's clock: nanoseconds of a double would show its last bits.
  constexpr std::int64_t kTicks = 10'000;
  const std::int64_t ticks = std::max<std::int64_t>(0, std::llround(t * kTicks));
  seconds = ticks / kTicks;
  nanoseconds = static_cast<std::uint32_t>(ticks % kTicks * 100'000);
}

Box::Box(const sensor::Blob& blob)
    : x((blob.x1 + blob.x2 + 1) / 2.0),
      y((blob.y1 + blob.y2 + 1) / 2.0),
      width(blob.bearing ? 0 : blob.x2 - blob.x1 + 1),
      height(blob.y2 - blob.y1 + 1) {}

std::string track_of(const sensor::Blob& blob) { return blob.track == 0 ? "" : std::to_string(blob.track); }

std::string mcap_of(const Run& run, const Encoding& encoding, double start) {
  return Recording(run, encoding, start).bytes();
}

}  // namespace fencepost::host::exports
