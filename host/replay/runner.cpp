#include "host/replay/runner.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/loop/loop.hpp"
#include "host/replay/complaints.hpp"
#include "host/replay/log_sensors.hpp"
#include "host/replay/models.hpp"
#include "host/replay/pass_watch.hpp"
#include "host/result/text.hpp"
#include "host/scene/pitch_note.hpp"

namespace fencepost::host {
namespace {

/// The robot's memory, with a journal that has room for all that one input can emit, and is emptied after each. The
/// robot used the inputs in its log, so a replay must use them too, whatever the robot's own buffers were.
template <class Base>
using Replayed = loop::Journaled<Base, loop::kLinesOfOneInput<Base> * record::kMaxLine>;

template <class Base>
class ProfileRunner final : public Runner {
 public:
  using Profile = Replayed<Base>;
  // At this distance, a cache's depth, objects would drive each other out of it: each frame looks at all of them.
  static_assert(sizeof(recon::Object<Profile>) % 4096 != 0);

  ProfileRunner(std::function<void(std::string_view)> log, bool inputs)
      : log_(std::move(log)),
        loop_(*memory_, camera_, odometry_, console_, console::Mode::kQuiet, loop::canned_stream<Base>()) {
    memory_->journal.start(inputs);
  }

  void start_run(const record::Header& header) override {
    header_ = header;
    loop_.pipeline().start_run(header_);
    passes_ = {};
    if (observer_ != nullptr) observer_->run_begins();
  }
  void take(const sensor::CameraIntrinsics& camera) override {
    loop_.pipeline().set_camera(camera);
    if (const std::optional<std::string> note = pitch_note(camera.mount)) complaints_.add(*note);
  }
  void take(const record::Signature& signature) override {
    if (loop_.pipeline().set_signature(signature)) return;
    complaints_.add("signature " + std::to_string(signature.signature) + ": profile " + std::string(Profile::kName) +
                    " names only " + std::to_string(Profile::kSignatures));
  }
  void take(const record::Setting& setting) override {
    if (!loop_.pipeline().set(setting.key.view(), setting.value.view())) return;
    complaints_.add("setting " + std::string(setting.key.view()) + " = " + std::string(setting.value.view()) +
                    " is not known here");
  }
  void take(const sensor::OdometrySample& sample) override {
    if (observer_ != nullptr) return take_observed(sample);
    odometry_.offer(sample);
    step(sample.t);
  }
  std::optional<sensor::OdometrySample> take(const sensor::CarSample& sample) override {
    const odometry::CarProblem problem = loop_.pipeline().problem_of(sample);
    if (problem != odometry::CarProblem::kNone)
      complaints_.add("$FPCAR is not used: " + std::string(config::reason(problem)));
    const base::Result<sensor::OdometrySample, record::Reject> pose = loop_.pipeline().integrate(sample);
    if (!pose) return std::nullopt;
    take(*pose);
    return *pose;
  }
  void take(const sensor::BlobFrame& frame) override {
    if (observer_ != nullptr) return take_observed(frame);
    camera_.offer(frame);
    step(frame.t);
  }
  void take(const record::Heartbeat& beat) override {
    loop_.pipeline().accept_passing(beat.t);
    step(beat.t);
  }
  void assume(const PoseNoise& noise) override {
    memory_->noise.position = static_cast<float>(noise.position);
    memory_->noise.heading = static_cast<float>(noise.heading);
  }
  void finish() override {
    loop_.pipeline().finish();
    loop_.pipeline().reporter().calibration();  // no further input waits for it
    hand_on_log();
  }
  void observe(RunObserver* observer) override { observer_ = observer; }

  [[nodiscard]] const console::Counters& counters() const override { return memory_->counters; }
  [[nodiscard]] std::uint64_t digest() const override { return memory_->map.digest(); }
  [[nodiscard]] const config::Settings& settings() const override { return memory_->settings; }
  [[nodiscard]] const std::vector<std::string>& complaints() const override { return complaints_.all(); }

  [[nodiscard]] const std::vector<PassResult>& passes() const override { return passes_.passes(); }

  [[nodiscard]] PoseResult pose_of(const sensor::OdometrySample& sample) const override {
    const recon::MapPose odometry = recon::to_map_pose(sample);
    const recon::MapPose pose = memory_->map.corrected(odometry);
    if (pose == odometry) {
      return {sample.t.to_double(), sample.x.to_double(), sample.y.to_double(), sample.heading.to_double()};
    }
    return {sample.t.to_double(), static_cast<double>(pose.position.x) / recon::kMapUnitsPerMetre,
            static_cast<double>(pose.position.y) / recon::kMapUnitsPerMetre, pose.heading * 1e-6};
  }

  [[nodiscard]] std::vector<ObjectResult> objects() const override {
    std::vector<ObjectResult> results;
    for (const auto& object : memory_->map.slots()) {
      if (object.used()) results.push_back(describe_object(object));
    }
    std::sort(results.begin(), results.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
    return results;
  }

  [[nodiscard]] std::vector<GuardPoint> guard() const override {
    constexpr std::int32_t kUnits = recon::kMapUnitsPerMetre / 1000;  // of a millimetre
    std::vector<GuardPoint> points;
    const recon::MapPoint origin = memory_->map.guard().origin();
    for (const recon::guard::Front& front : memory_->map.guard().fronts()) {
      if (!recon::guard::enough_frames(front.frames)) continue;
      const recon::MapPose odometry{{origin.x + front.x * kUnits, origin.y + front.y * kUnits}, 0};
      const recon::MapPoint place = memory_->map.corrected(odometry).position;
      points.push_back({static_cast<double>(place.x) / recon::kMapUnitsPerMetre,
                        static_cast<double>(place.y) / recon::kMapUnitsPerMetre, front.signature});
    }
    return points;
  }

  [[nodiscard]] std::optional<record::SectorReport> sectors() const override {
    if constexpr (Profile::kSeesFloor) {
      if (!memory_->poses.empty()) return loop::sectors_of(*memory_);
    }
    return std::nullopt;
  }
  [[nodiscard]] std::optional<record::WayReport> ways() const override {
    if constexpr (Profile::kSeesFloor) {
      if (!memory_->poses.empty()) {
        return loop::ways_of(*memory_, loop::kPassAnywhere);
      }
    }
    return std::nullopt;
  }

  [[nodiscard]] record::SpeedLimit speed_limit() const override {
    return loop_.pipeline().speed_limit(loop_.pipeline().in_force());
  }

 private:
  void step(base::Time now) {
    loop_.step(now);
    note_doubt(memory_->camera_doubt.said().doubt);
    watch_passes();
    hand_on_log();
  }

  void hand_on_log() {
    const std::span<const char> lines = memory_->journal.waiting();
    log_({lines.data(), lines.size()});
    memory_->journal.taken(lines.size());
  }

  void watch_passes() {
    if (memory_->poses.empty()) return;
    const recon::MapPose robot = robot_pose(*memory_);
    const double c = std::cos(robot.heading * 1e-6);
    const double s = std::sin(robot.heading * 1e-6);
    const double t = memory_->run.time->to_double();
    for (const recon::ObjectCore& object : memory_->map.slots_in_use()) {
      const recon::CylinderEstimate& cylinder = object.cylinder.estimate();
      if (!object.used() || !object.confirmed || !cylinder.ok()) continue;
      const recon::Vec2 to = recon::offset_from(robot.position, recon::moved(object.origin, cylinder.center));
      const double x = static_cast<double>(to.x());
      const double y = static_cast<double>(to.y());
      passes_.look(t, object.id, object.signature, {c * x + s * y, c * y - s * x},
                   static_cast<double>(cylinder.radius));
    }
    passes_.forget_lost(memory_->map.slots().size(), [this](std::uint32_t id) { return in_map(id); });
    if (passes_.full()) {
      complaints_.add("only the first " + std::to_string(PassWatch::kMax) + " things that were passed are listed");
    }
  }

  [[nodiscard]] bool in_map(std::uint32_t id) const {
    const auto slots = memory_->map.slots_in_use();
    return std::any_of(slots.begin(), slots.end(),
                       [&](const recon::ObjectCore& object) { return object.used() && object.id == id; });
  }

  // Once for each time that it begins; by how much is in the log.
  void note_doubt(record::Doubt doubt) {
    if (doubt == noted_) return;
    noted_ = doubt;
    if (doubt == record::Doubt::kNone) return;
    complaints_.add(calibration_sentence(memory_->camera_doubt.said()));
  }

  // As the loop handles one input, but with a pause after each frame. A step without input only empties the journal.
  template <class Input>
  void take_observed(const Input& input) {
    loop::Pipeline<Profile>& pipeline = loop_.pipeline();
    pipeline.accept(input);
    step(input.t);
    while (place_observed()) step(input.t);
    pipeline.watch_without_frames();
    pipeline.send_status();
    step(input.t);
  }

  bool place_observed() {
    return loop_.pipeline().place_next_frame([this](const recon::WaitingFrame& frame) { show(frame); });
  }

  void show(const recon::WaitingFrame& frame) {
    const auto slots = memory_->map.slots();
    std::vector<PlacedSighting> sightings;
    for (std::size_t o = 0; o < slots.size(); ++o) {
      if (!slots[o].used() || !memory_->map.seen_now(o)) continue;
      sightings.push_back({slots[o].id, slots[o].views, memory_->map.blob_of(o)});
    }
    const auto find = [&](std::uint32_t id) -> const recon::Object<Profile>& {
      return *std::find_if(slots.begin(), slots.end(), [&](const auto& object) { return object.id == id; });
    };
    observer_->frame_placed({frame, sightings, [&](std::uint32_t id) { return describe_object(find(id)); },
                             [&](std::uint32_t id) { return outline_object(find(id)); },
                             [this](std::uint32_t id) { return in_map(id); }, [this] { return sectors(); },
                             [this] { return ways(); }});
  }

  [[nodiscard]] ObjectResult describe_object(const recon::Object<Profile>& object) const {
    ObjectResult result = numbers_of(object);
    result.models = models_of(object);
    result.next = next_of(object);
    return result;
  }

  [[nodiscard]] ObjectResult outline_object(const recon::Object<Profile>& object) const {
    ObjectResult result = numbers_of(object);
    result.models.push_back(cylinder_model(object));
    add_results(object, object.hybrid(), result.models);
    return result;
  }

  [[nodiscard]] ObjectResult numbers_of(const recon::Object<Profile>& object) const {
    ObjectResult result;
    result.id = object.id;
    result.signature = object.signature;
    result.state = console::state_of(object, memory_->run.time.value_or(base::Time{}));
    result.views = object.views;
    result.confidence = static_cast<double>(object.confidence());
    const recon::CylinderEstimate& cylinder = object.cylinder.estimate();
    if (cylinder.ok()) {
      const recon::HeightRange band = object.band.at(cylinder.center, cylinder.radius);
      result.sigma = std::sqrt(0.5 * static_cast<double>(cylinder.covariance.xx + cylinder.covariance.yy));
      result.z_min = static_cast<double>(band.z_min);
      result.z_max = static_cast<double>(band.z_max);
      // Rows whose trend gives a depth too great belong to a foot above the floor, or to what hides it.
      const bool raised = object.cylinder.row_trend().verdict() == recon::RowVerdict::kTooFar;
      if (raised && band.bottom_known) result.base = result.z_min;
    }
    return result;
  }

  [[nodiscard]] std::optional<NextViewResult> next_of(const recon::Object<Profile>& object) const {
    const auto slot = static_cast<std::size_t>(&object - memory_->map.slots().data());
    const recon::NextView next = loop::next_view_of(*memory_, slot);
    if (!next.ok()) return std::nullopt;
    const recon::MapPoint place = recon::moved(object.hybrid().origin, next.place);
    NextViewResult result;
    result.bearing = std::atan2(static_cast<double>(next.toward.y()), static_cast<double>(next.toward.x()));
    result.width = static_cast<double>(next.width);
    result.x = static_cast<double>(place.x) / recon::kMapUnitsPerMetre;
    result.y = static_cast<double>(place.y) / recon::kMapUnitsPerMetre;
    result.gain = static_cast<double>(next.gain);
    return result;
  }

  std::unique_ptr<loop::Memory<Profile>> memory_ = std::make_unique<loop::Memory<Profile>>();
  record::Header header_;
  LogCamera camera_;
  LogOdometry odometry_;
  NoConsole console_;
  std::function<void(std::string_view)> log_;
  loop::Loop<Profile, LogCamera, LogOdometry, NoConsole> loop_;
  Complaints complaints_;
  PassWatch passes_;
  record::Doubt noted_ = record::Doubt::kNone;
  RunObserver* observer_ = nullptr;
};

}  // namespace

std::unique_ptr<Runner> make_runner(std::string_view profile, std::function<void(std::string_view)> log, bool inputs) {
  const auto make = [&]<class Profile>() {
    return std::make_unique<ProfileRunner<Compared<Profile>>>(std::move(log), inputs);
  };
  if (profile == config::Micro::kName) return make.template operator()<config::Micro>();
  if (profile == config::Small::kName) return make.template operator()<config::Small>();
  if (profile == config::Full::kName) return make.template operator()<config::Full>();
  return nullptr;
}

}  // namespace fencepost::host
