#include "tests/studies/calibrate/faulty_drive.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "firmware/record/stream_reader.hpp"
#include "host/geometry/polygon.hpp"
#include "host/simulate/random.hpp"
#include "host/simulate/simulate.hpp"
#include "tests/firmware/record/lines.hpp"

namespace fencepost::test {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180;

/// Writes what it reads, with the fault in it.
struct Spoiler {
  Fault fault;
  double sign;
  double way = 1;  ///< reported over true
  double turn = 1;
  std::string log{};
  std::optional<sensor::OdometrySample> truth{};
  host::TimedPose reported{};

  void accept(sensor::CameraIntrinsics camera) {
    const auto off = [&](auto& quantity, double by) {
      using Quantity = std::remove_reference_t<decltype(quantity)>;
      quantity = Quantity::nearest(quantity.to_double() + sign * by);
    };
    if (fault == Fault::kTilt) off(*camera.mount.pitch, 3 * kRadiansPerDegree);
    if (fault == Fault::kYaw) off(camera.mount.yaw, 3 * kRadiansPerDegree);
    if (fault == Fault::kLatency) off(camera.latency, 0.04);
    if (fault == Fault::kHeight) off(camera.mount.z, 0.03);
    if (fault == Fault::kFocal) {
      off(camera.fx, 0.08 * camera.fx.to_double());
      camera.fy = camera.fx;
    }
    log += record::encoded(camera);
  }
  void accept(record::Signature signature) {
    if (fault == Fault::kWidth && signature.signature == 1 && signature.width > 0) {
      signature.width = static_cast<std::uint16_t>(sign > 0 ? 2 * signature.width : signature.width / 2);
    }
    log += record::encoded(signature);
  }
  void accept(sensor::BlobFrame frame) {
    for (sensor::Blob& blob : frame.blobs) {
      if (fault != Fault::kPadOne || blob.signature != 1) continue;
      constexpr std::int16_t kPad = 4;
      if (blob.x1 > 0) blob.x1 = std::max<std::int16_t>(0, static_cast<std::int16_t>(blob.x1 - kPad));
      if (blob.y1 > 0) blob.y1 = std::max<std::int16_t>(0, static_cast<std::int16_t>(blob.y1 - kPad));
      if (blob.x2 < 315) blob.x2 = std::min<std::int16_t>(315, static_cast<std::int16_t>(blob.x2 + kPad));
      if (blob.y2 < 207) blob.y2 = std::min<std::int16_t>(207, static_cast<std::int16_t>(blob.y2 + kPad));
    }
    log += record::encoded(frame);
  }
  void accept(sensor::OdometrySample sample) {
    const double heading = sample.heading.to_double();
    if (truth) {
      const double dx = (sample.x - truth->x).to_double();
      const double dy = (sample.y - truth->y).to_double();
      const double turned = std::remainder(heading - truth->heading.to_double(), 2 * std::numbers::pi);
      const double from = truth->heading.to_double() + turned / 2;
      const double ahead = std::cos(from) * dx + std::sin(from) * dy;
      const double left = std::cos(from) * dy - std::sin(from) * dx;
      const double to = reported.heading + turn * turned / 2;
      reported.x += way * (std::cos(to) * ahead - std::sin(to) * left);
      reported.y += way * (std::sin(to) * ahead + std::cos(to) * left);
      reported.heading += turn * turned;
    } else {
      reported = {0, sample.x.to_double(), sample.y.to_double(), heading};
    }
    truth = sample;
    sample.x = base::Metres::nearest(reported.x);
    sample.y = base::Metres::nearest(reported.y);
    sample.heading = base::Radians::nearest(std::remainder(reported.heading, 2 * std::numbers::pi));
    log += record::encoded(sample);
  }
  template <class Record>
  void accept(const Record& record) {
    log += record::encoded(record);
  }
};

double outline_length(const host::LinearRing& ring) {
  double length = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const host::Point& a = ring[i];
    const host::Point& b = ring[(i + 1) % ring.size()];
    length += std::hypot(b.x - a.x, b.y - a.y);
  }
  return length;
}

}  // namespace

std::string faulty_drive(const DriveOptions& options, Fault fault, bool widths) {
  DriveOptions clean = options;
  clean.drift = 0.3;
  if (fault == Fault::kPadAll) clean.pad = 3;
  host::Scene scene = calibration_drive(clean).scene;
  for (std::size_t i = 0; widths && i < scene.signatures.size(); ++i) {
    scene.signatures[i].width = static_cast<std::uint16_t>(
        std::lround(1000 * outline_length(scene.objects[i].footprint.outer) / std::numbers::pi));
  }
  host::Random random(options.seed, host::Purpose::kDrift, 78);
  Spoiler spoiler{fault, random.chance(0.5) ? 1.0 : -1.0};
  if (fault == Fault::kTurns) spoiler.turn = 1 + spoiler.sign * 0.08;
  if (fault == Fault::kWays) spoiler.way = 1 + spoiler.sign * 0.12;
  std::string log;
  const auto simulated = host::simulate(scene, [&](std::string_view line) { log += line; });
  if (!simulated) throw std::runtime_error(simulated.error());
  std::array<char, record::StreamReader::kBuffer> buffer{};
  record::StreamReader reader(buffer);
  std::string_view bytes = log;
  while (!bytes.empty()) reader.take(bytes, spoiler);
  return spoiler.log;
}

}  // namespace fencepost::test
