#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "host/geometry/median.hpp"
#include "host/import/import.hpp"
#include "host/import/kitti/kitti_files.hpp"
#include "host/import/log_builder.hpp"
#include "host/import/table.hpp"
#include "host/import/take.hpp"

namespace fencepost::host {
namespace {

constexpr double kKittiLensHeight = 1.65;  // m above the road; source: KITTI's description of its car
constexpr double kCarWidth = 1.8;          // m, of the recording car

/// Which labelled cars were parked: m, of the places that one track has in the world.
constexpr double kMaxScatter = 0.6;     // median distance from the median place
constexpr double kMaxTravel = 2.5;      // from the first to the last place
constexpr std::size_t kMinLabels = 8;   // fewer say too little
constexpr double kMinSeparation = 1.7;  // of two cars' centres: nearer, one car has two tracks
constexpr std::size_t kSignatures = 255;
constexpr int kIds = 65'535;

template <class Item, class Value>
double median_of(const std::vector<Item>& items, std::size_t count, Value value) {
  std::vector<double> values;
  for (std::size_t i = 0; i < std::min(count, items.size()); ++i) values.push_back(value(items[i]));
  return host::median_of(std::move(values));
}

/// One label of a track, placed in the world.
struct Placed {
  std::size_t frame = 0;
  const KittiLabel* label = nullptr;
  Point at;
  double heading = 0;
};

double distance(Point a, Point b) { return std::hypot(a.x - b.x, a.y - b.y); }

/// The place of a parked car, by the half of its labels with the least range; nothing of one that moves.
struct ParkedCar {
  Point centre;
  double heading = 0;
  const KittiLabel* nearest = nullptr;
};

std::optional<ParkedCar> parked(std::vector<Placed> labels) {
  if (labels.size() < kMinLabels) return std::nullopt;
  const double travel = distance(labels.front().at, labels.back().at);
  std::ranges::stable_sort(labels, {}, [](const Placed& p) { return p.label->z; });
  const std::size_t near = std::max(kMinLabels, labels.size() / 2);
  ParkedCar car;
  car.centre = {median_of(labels, near, [](const Placed& p) { return p.at.x; }),
                median_of(labels, near, [](const Placed& p) { return p.at.y; })};
  const double scatter = median_of(labels, labels.size(), [&](const Placed& p) { return distance(p.at, car.centre); });
  if (scatter > kMaxScatter || travel > kMaxTravel) return std::nullopt;
  // Twice the heading: front and back of a label are exchanged now and then.
  car.heading = std::atan2(median_of(labels, near, [](const Placed& p) { return std::sin(2 * p.heading); }),
                           median_of(labels, near, [](const Placed& p) { return std::cos(2 * p.heading); })) /
                2;
  car.nearest = labels.front().label;
  return car;
}

class KittiImport {
 public:
  KittiImport(KittiDrive drive, const KittiOptions& options) : drive_(std::move(drive)), options_(options) {
    for (std::size_t i = 0; i < drive_.frames.size(); ++i) {
      const KittiFrame& frame = drive_.frames[i];
      for (const KittiLabel& label : frame.labels) {
        if (!label.is_car()) continue;
        // A label's yaw turns from right to ahead; 0 points right.
        tracks_[label.track].push_back(
            {i, &label, frame.place(label.x, label.z), frame.pose.heading - label.yaw - std::numbers::pi / 2});
      }
    }
  }

  Imported run(const std::string& source) {
    Taken taken;
    const auto detections = options_.detections.empty() ? std::vector<std::vector<KittiBox>>()
                                                        : read_detections(options_.detections, drive_.frames.size());
    for (std::size_t i = 0; i < drive_.frames.size(); ++i) {
      const KittiFrame& frame = drive_.frames[i];
      taken.poses.push_back(
          {frame.pose.t, options_.scale * frame.pose.x, options_.scale * frame.pose.y, frame.pose.heading});
      TakenFrame made{frame.pose.t, {}};
      if (detections.empty()) {
        add_labels(frame, made, taken);
      } else {
        for (const KittiBox& box : detections[i]) add_box(box, 1, 0, made);
      }
      taken.frames.push_back(std::move(made));
    }
    if (drive_.frames_without_pose > 0) taken.skipped["frames without a pose"] = drive_.frames_without_pose;
    taken.notes.push_back(options_.identity ? "every car is of a signature of its own"
                                            : "every car is of one signature");
    name_signatures(taken);
    TakeSettings settings;
    settings.camera = camera();
    Imported imported = log_of(std::move(taken), settings, source, "import-kitti");
    imported.truth = truth(*settings.camera);
    return imported;
  }

 private:
  [[nodiscard]] int signature_of(int track) const {
    if (!options_.identity) return 1;
    const auto index = static_cast<std::size_t>(std::distance(tracks_.begin(), tracks_.find(track)));
    return static_cast<int>(1 + index % kSignatures);
  }

  [[nodiscard]] std::uint16_t id_of(int track) const {
    return options_.ids ? static_cast<std::uint16_t>(1 + track % kIds) : std::uint16_t{0};
  }

  static void add_box(const KittiBox& box, int signature, std::uint16_t id, TakenFrame& frame) {
    ImportedBlob blob;
    blob.signature = signature;
    blob.track = id;
    blob.x1 = box.x1;
    blob.y1 = box.y1;
    blob.x2 = box.x2;
    blob.y2 = box.y2;
    frame.blobs.push_back(blob);
  }

  void add_labels(const KittiFrame& frame, TakenFrame& made, Taken& taken) const {
    for (const KittiLabel& label : frame.labels) {
      if (!label.is_car()) {
        ++taken.skipped["labels of other things than cars"];
      } else if (!label.is_shown()) {
        ++taken.skipped["labels of cars that are largely hidden"];
      } else {
        add_box(label.box, signature_of(label.track), id_of(label.track), made);
      }
    }
  }

  void name_signatures(Taken& taken) const {
    if (!options_.identity) {
      taken.names[1] = "car";
      return;
    }
    for (const auto& [track, labels] : tracks_) taken.names[signature_of(track)] = name_of(track);
  }

  [[nodiscard]] std::string name_of(int track) const { return tracks_.at(track).front().label->name(); }

  [[nodiscard]] sensor::CameraIntrinsics camera() const {
    sensor::CameraIntrinsics camera;
    camera.model = "kitti";
    camera.width = static_cast<std::uint16_t>(drive_.width);
    camera.height = static_cast<std::uint16_t>(drive_.height);
    camera.fx = base::Pixels2::nearest(drive_.focal);
    camera.fy = camera.fx;
    camera.cx = base::Pixels2::nearest(drive_.cx);
    camera.cy = base::Pixels2::nearest(drive_.cy);
    camera.mount.z = base::Metres::nearest(options_.scale * kKittiLensHeight);
    if (options_.pitch) camera.mount.pitch = base::Radians::nearest(*options_.pitch);
    return camera;
  }

  [[nodiscard]] Scene truth(const sensor::CameraIntrinsics& camera) const {
    Scene scene;
    scene.camera = camera;
    scene.rate = kKittiRate;
    scene.robot.width = options_.scale * kCarWidth;
    if (!options_.identity) scene.signatures.push_back({1, "car", colour_number(0, 1)});
    std::vector<Point> taken;
    for (const auto& [track, labels] : tracks_) {
      const auto signature = static_cast<std::uint8_t>(signature_of(track));
      if (options_.identity && scene.signatures.size() < kSignatures)
        scene.signatures.push_back({signature, name_of(track), colour_number(signature, tracks_.size())});
      const auto car = parked(labels);
      if (!car) continue;
      if (std::ranges::any_of(taken, [&](Point other) { return distance(other, car->centre) <= kMinSeparation; }))
        continue;
      taken.push_back(car->centre);
      scene.objects.push_back({name_of(track), signature, 0, options_.scale * car->nearest->height, {ring(*car), {}}});
    }
    return scene;
  }

  [[nodiscard]] std::vector<Point> ring(const ParkedCar& car) const {
    const double c = std::cos(car.heading);
    const double s = std::sin(car.heading);
    std::vector<Point> ring;
    for (const auto& [ahead, left] : {std::pair{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}) {
      const double u = ahead * car.nearest->length / 2;
      const double v = left * car.nearest->width / 2;
      ring.push_back(
          {options_.scale * (car.centre.x + c * u - s * v), options_.scale * (car.centre.y + s * u + c * v)});
    }
    return ring;
  }

  KittiDrive drive_;
  const KittiOptions& options_;
  std::map<int, std::vector<Placed>> tracks_;  ///< of cars
};

void check(const KittiOptions& options) {
  if (!(options.scale > 0 && options.scale <= 1)) {
    throw ImportProblem{"--scale", "is out of range", "allowed: more than 0, up to 1"};
  }
  if ((options.identity || options.ids) && !options.detections.empty()) {
    throw ImportProblem{options.ids ? "--ids" : "--identity", "does not go with --detections",
                        "a detector does not tell which car is which"};
  }
}

}  // namespace

ImportResult import_kitti(const std::string& folder, const KittiOptions& options) {
  try {
    check(options);
    return KittiImport(read_kitti(folder), options).run(folder);
  } catch (const ImportProblem& problem) {
    return problem;
  }
}

}  // namespace fencepost::host
