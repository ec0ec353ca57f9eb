#include "host/merge/relocate.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include "firmware/recon/observe/frame_queue.hpp"
#include "firmware/recon/observe/observation.hpp"
#include "firmware/recon/observe/pose_history.hpp"
#include "firmware/record/stream_reader.hpp"

namespace fencepost::host {
namespace {

/// Odometry, frames and the calibration of one run.
struct RunSink {
  const RelocateOptions& options;
  std::optional<sensor::CameraIntrinsics> camera{};
  std::vector<sensor::OdometrySample> odometry{};
  std::vector<sensor::BlobFrame> frames{};
  std::map<std::uint8_t, std::int16_t> pads{};  ///< px, by signature

  [[nodiscard]] bool wanted(base::Time t) const {
    return !(options.from && t.to_double() < *options.from) && !(options.to && t.to_double() > *options.to);
  }
  void accept(const sensor::CameraIntrinsics& told) { camera = told; }
  void accept(const record::Signature& signature) { pads[signature.signature] = signature.pad; }
  void accept(const sensor::OdometrySample& sample) {
    if (wanted(sample.t)) odometry.push_back(sample);
  }
  void accept(const sensor::BlobFrame& frame) {
    if (wanted(frame.t)) frames.push_back(frame);
  }
  template <class Record>
  void accept(const Record& /*tells no place*/) {}
};

class Drive {
 public:
  Drive(const RunSink& run, std::span<const recon::ConstellationPoint> known)
      : run_(run), known_(known), camera_(recon::make_camera_model(*run.camera)), filter_(known) {
    noise_.edge_px = camera_.edge_px;
  }

  std::optional<Relocated> search() {
    for (const sensor::BlobFrame& frame : run_.frames) {
      const std::optional<recon::MapPose> pose = pose_at(frame.t - camera_.latency);
      if (!pose || !look(frame, *pose)) continue;
      if (const auto found = filter_.found()) return relocated(frame, *pose, *found);
    }
    return std::nullopt;
  }

 private:
  // False: it brought nothing.
  bool look(const sensor::BlobFrame& frame, const recon::MapPose& pose) {
    if (last_) {
      const auto turned = static_cast<float>(recon::short_way(std::int64_t{pose.heading} - last_->heading));
      filter_.drive(recon::offset_from(last_->position, pose.position), 1e-6F * turned);
    }
    last_ = pose;
    const recon::LensPose lens = recon::lens_pose(pose, camera_);
    recon::WaitingFrame waiting = recon::make_waiting(frame, 0);
    const auto pad_of = [this](std::uint8_t signature) {
      const auto known = run_.pads.find(signature);
      return known == run_.pads.end() ? std::int16_t{0} : known->second;
    };
    recon::take_off_pads(camera_, pad_of, waiting);
    recon::Observations observations;
    recon::observe(waiting.blobs.view(), camera_, observations);
    bool any = false;
    for (const recon::Observation& seen : observations) {
      const auto radius = recon::radius_of(known_, seen.signature);
      if (!radius) continue;
      const auto ranged = recon::ranged(recon::make_sighting(camera_, lens, seen), *radius, noise_);
      if (!ranged) continue;
      filter_.see(*ranged, seen.signature);
      any = true;
    }
    return any;
  }

  [[nodiscard]] Relocated relocated(const sensor::BlobFrame& frame, const recon::MapPose& pose,
                                    const recon::Relocation& found) const {
    recon::FrameMotion motion{found.rotation, {0, 0}};
    motion.shift = found.place - motion.of(recon::offset_from({}, pose.position));
    return {(frame.t - run_.frames.front().t).to_double(), motion, found};
  }

  [[nodiscard]] std::optional<recon::MapPose> pose_at(base::Time t) const {
    const auto after = std::ranges::lower_bound(run_.odometry, t, {}, &sensor::OdometrySample::t);
    if (after == run_.odometry.end() || after == run_.odometry.begin()) return std::nullopt;
    const auto sample = [](const sensor::OdometrySample& from) {
      return recon::PoseSample{static_cast<std::uint32_t>(from.t.raw), recon::to_map_pose(from), false};
    };
    if (after->t - (after - 1)->t > recon::kMoment) return std::nullopt;
    return recon::interpolate(sample(*(after - 1)), sample(*after), static_cast<std::uint32_t>(t.raw));
  }

  const RunSink& run_;
  std::span<const recon::ConstellationPoint> known_;
  recon::CameraModel camera_;
  recon::MeasurementNoise noise_;
  recon::RelocationFilter filter_;
  std::optional<recon::MapPose> last_;
};

}  // namespace

std::optional<Relocated> relocate(std::string_view run, std::span<const recon::ConstellationPoint> known,
                                  const RelocateOptions& options) {
  RunSink sink{options};
  sink.camera = options.camera;
  std::array<char, record::StreamReader::kBuffer> buffer{};
  record::StreamReader reader(buffer);
  reader.push(run, sink);
  reader.finish();
  if (!sink.camera || sink.odometry.empty() || sink.frames.empty()) return std::nullopt;
  return Drive(sink, known).search();
}

}  // namespace fencepost::host
