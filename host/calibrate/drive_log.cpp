#include "host/calibrate/drive_log.hpp"

#include <algorithm>
#include <array>

#include "drivers/odometry/car_drive.hpp"
#include "firmware/config/car.hpp"
#include "firmware/record/stream_reader.hpp"

namespace fencepost::host {
namespace {

/// Odometry, calibration and signatures of the last run.
struct DriveSink {
  const ReplayOptions& options;
  DriveLog log{};
  bool configured = false;
  double now = -1;           ///< s, of the last frame
  double camera_since = -1;  ///< frames up to then were of another calibration
  config::Settings settings{};
  odometry::CarDrive car{};
  std::optional<base::Time> car_read{};

  void accept(const record::Header&) {
    log = DriveLog{};
    begin_odometry();
    configured = false;
    now = camera_since = -1;
    if (options.camera) accept(*options.camera);
  }
  void accept(const sensor::CameraIntrinsics& camera) {
    if (configured && !(camera == log.camera) && now >= 0) {
      log.camera_changed = true;
      camera_since = now;
    }
    log.camera = camera;
    configured = true;
  }
  void accept(const record::Signature& signature) {
    const auto known = std::ranges::find(log.signatures, signature.signature, &record::Signature::signature);
    if (known == log.signatures.end()) {
      log.signatures.push_back(signature);
    } else {
      *known = signature;
    }
  }
  void accept(const sensor::OdometrySample& sample) {
    const double t = sample.t.to_double();
    if ((options.from && t < *options.from) || (options.to && t > *options.to)) return;
    log.odometry.push_back({t, sample.x.to_double(), sample.y.to_double(), sample.heading.to_double()});
  }
  void accept(const record::Setting& setting) {
    if (!is_forced(setting.key.view())) (void)settings.set(setting.key.view(), setting.value.view());
  }
  /// As the robot turns a car's readings into poses.
  void accept(const sensor::CarSample& sample) {
    const odometry::CarGeometry geometry = config::car_of(settings);
    if (odometry::problem_of(sample, geometry) != odometry::CarProblem::kNone) return;
    if (car_read && sample.t <= *car_read) return;
    car_read = sample.t;
    accept(car.take(sample, geometry));
  }
  void accept(const sensor::BlobFrame& frame) { now = frame.t.to_double(); }
  template <class Record>
  void accept(const Record&) {}

  void begin_odometry() {
    settings = {};
    for (const auto& [key, value] : options.settings) (void)settings.set(key, value);
    car = {};
    car_read.reset();
  }
  [[nodiscard]] bool is_forced(std::string_view key) const {
    return std::ranges::any_of(options.settings, [key](const auto& setting) { return setting.first == key; });
  }
};

/// Edges of two boxes that come so near may be one edge that hides the other, px.
constexpr int kTouching = 3;

bool overlap(int low_a, int high_a, int low_b, int high_b) {
  return low_a <= high_b + kTouching && low_b <= high_a + kTouching;
}

/// Whether the box at column `u` may end because `other`, whose foot is not higher, begins there.
bool hides_end(const recon::Box& box, int u, const recon::Box& other) {
  return other.y2 >= box.y2 - kTouching && overlap(box.y1, box.y2, other.y1, other.y2) &&
         overlap(u, u, other.x1, other.x2);
}

class Watcher final : public RunObserver {
 public:
  Watcher(DriveLog& log, double since) : log_(log), since_(since) {}

  void run_begins() override {
    log_.frames.clear();
    log_.moving = 0;
  }

  void frame_placed(const PlacedFrame& placed) override {
    const double t = placed.frame.t.to_double();
    if (t <= since_) return;
    SeenFrame seen{t, {}, {}};
    std::vector<bool> taken(placed.frame.blobs.size());
    for (const recon::WaitingBlob& blob : placed.frame.blobs) log_.moving += blob.moves ? 1U : 0U;
    for (const PlacedSighting& sighting : placed.sightings) {
      const recon::WaitingBlob& blob = placed.frame.blobs[sighting.blob];
      taken[sighting.blob] = true;
      if (blob.moves || blob.bearing) continue;
      seen.boxes.push_back(box_of(placed.frame, sighting.blob));
      seen.boxes.back().object = sighting.id;
      count_ends(seen.boxes.back());
    }
    for (std::size_t i = 0; i < taken.size(); ++i) {
      const recon::WaitingBlob& blob = placed.frame.blobs[i];
      if (!taken[i] && !blob.moves && !blob.bearing) seen.others.push_back(box_of(placed.frame, i));
    }
    if (!seen.boxes.empty() || !seen.others.empty()) log_.frames.push_back(std::move(seen));
  }

 private:
  SeenBox box_of(const recon::WaitingFrame& frame, std::size_t index) {
    const recon::Box& box = frame.blobs[index].box;
    SeenBox seen;
    seen.signature = frame.blobs[index].signature;
    seen.row_low = box.y1 - 0.5;
    seen.row_high = box.y2 + 0.5;
    seen.middle = 0.5 * (box.x1 + box.x2);
    // The border rules of the stream format.
    if (box.x1 > 1) seen.left = box.x1 - 0.5;
    if (box.x2 < log_.camera.width - 2) seen.right = box.x2 + 0.5;
    if (box.y1 > 1) seen.top = seen.row_low;
    if (box.y2 < log_.camera.height - 2) seen.foot = seen.row_high;
    for (std::size_t i = 0; i < frame.blobs.size(); ++i) {
      if (i != index && !frame.blobs[i].bearing) leave_out_hidden(box, frame.blobs[i].box, seen);
    }
    leave_out_cut(seen);
    return seen;
  }

  /// Where an end is missing, the nearest point of the footprint may be missing too: the foot of the rest is farther
  /// up.
  static void leave_out_cut(SeenBox& seen) {
    if (seen.left && seen.right) return;
    seen.foot.reset();
    seen.top.reset();
  }

  void count_ends(const SeenBox& seen) {
    log_.ends += 2;
    log_.ends_cut += (seen.left ? 0U : 1U) + (seen.right ? 0U : 1U);
  }

  static void leave_out_hidden(const recon::Box& box, const recon::Box& other, SeenBox& seen) {
    if (hides_end(box, box.x1, other)) seen.left.reset();
    if (hides_end(box, box.x2, other)) seen.right.reset();
    if (!overlap(box.x1, box.x2, other.x1, other.x2)) return;
    if (other.y2 >= box.y2 && other.y1 <= box.y2 + kTouching) seen.foot.reset();
    if (other.y1 <= box.y1 + kTouching && other.y2 >= box.y1) seen.top.reset();
  }

  DriveLog& log_;
  double since_;
};

}  // namespace

DriveLog read_drive(std::string_view bytes, const std::string& name, ReplayOptions options, ReplayOutcome& outcome) {
  DriveSink sink{options};
  sink.begin_odometry();
  if (options.camera) sink.accept(*options.camera);
  std::array<char, record::StreamReader::kBuffer> buffer{};
  record::StreamReader reader(buffer);
  reader.push(bytes, sink);
  reader.finish();
  Watcher watcher(sink.log, sink.camera_since);
  options.observer = &watcher;
  outcome = replay(bytes, name, options);
  return std::move(sink.log);
}

}  // namespace fencepost::host
