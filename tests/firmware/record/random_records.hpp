// Records drawn over the full ranges of their fields, the limits themselves included more often than chance would.
#pragma once

#include <cstdint>
#include <optional>
#include <random>

#include "tests/firmware/record/lines.hpp"

namespace fencepost::record {

class RandomRecords {
 public:
  explicit RandomRecords(std::uint64_t seed) : bits_(seed) {}

  std::uint64_t bits() { return bits_(); }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(bits_() % n); }
  bool chance(std::size_t one_in) { return below(one_in) == 0; }

  /// min or max in a quarter of the draws, near zero in another.
  std::int64_t between(std::int64_t min, std::int64_t max) {
    const std::size_t way = below(8);
    if (way == 0) return min;
    if (way == 1) return max;
    if (way <= 3 && min <= 0 && max >= 20) return static_cast<std::int64_t>(below(20)) - (min <= -20 ? 10 : 0);
    const auto span = static_cast<std::uint64_t>(max - min) + 1;
    return min + static_cast<std::int64_t>(bits_() % span);
  }

  /// Any bytes, or mostly printable ones.
  sensor::Text text() {
    sensor::Text text;
    const bool printable = !chance(3);
    const std::size_t size = chance(4) ? sensor::kMaxText : below(sensor::kMaxText + 1);
    for (std::size_t i = 0; i < size; ++i) {
      const auto byte = static_cast<char>(printable ? ' ' + static_cast<int>(below(95)) : static_cast<int>(below(256)));
      if (!text.push_back(byte)) break;
    }
    return text;
  }

  sensor::Blob blob(std::int64_t max_u, std::int64_t max_v, std::int64_t min = 0) {
    sensor::Blob blob;
    blob.signature = u8();
    const std::int64_t u1 = between(min, max_u);
    const std::int64_t v1 = between(min, max_v);
    blob.x1 = static_cast<std::int16_t>(u1);
    blob.y1 = static_cast<std::int16_t>(v1);
    blob.x2 = static_cast<std::int16_t>(between(u1, max_u));
    blob.y2 = static_cast<std::int16_t>(between(v1, max_v));
    blob.cx = {i32(-327'680, 327'670)};
    blob.cy = {i32(-327'680, 327'670)};
    blob.pixels = u32();
    if (chance(2)) blob.rgb = rgb();
    return blob;
  }

  AnyRecord any() { return any(static_cast<Kind>(below(kKinds))); }

  AnyRecord any(Kind kind) {
    switch (kind) {
      case Kind::kHeader: return Header{kStreamFormat, text(), text(), text(), text()};
      case Kind::kCamera: return camera();
      case Kind::kSignature:
        return Signature{u8(), rgb(), text(), static_cast<std::int8_t>(below(2) == 0 ? 0 : between(-100, 100)),
                         static_cast<std::uint16_t>(between(0, 2000))};
      case Kind::kOdometry: return sensor::OdometrySample{time(), position(), position(), heading()};
      case Kind::kFrame: return frame();
      case Kind::kPosition:
        return Position{time(), position(), position(), heading(), {i32(0, 10'000'000)}, {i32(0, 10'000'000)}};
      case Kind::kObject: return object();
      case Kind::kAlert: return alert();
      case Kind::kDigest: return DigestReport{u32(), chance(8) ? below(2) - 1 : bits()};
      case Kind::kLink: return LinkReport{time(), text(), static_cast<sensor::LinkState>(below(5)), text()};
      case Kind::kStatus: return StatusReport{time(), u32(), u32(), u32(), u32(), u32(), u32(), u32(), u32(), u32()};
      case Kind::kSetting: return Setting{text(), text()};
      case Kind::kHeartbeat:
        return Heartbeat{time(), static_cast<AlertLevel>(below(5)), static_cast<sensor::LinkState>(below(5)),
                         static_cast<sensor::LinkState>(below(5))};
      case Kind::kCalibrationDoubt: return CalibrationDoubt{time(), static_cast<Doubt>(below(3)), {i32(1, 10'000)}};
      case Kind::kCar: return car();
      case Kind::kSectors: return sectors();
      case Kind::kWays: return ways();
      case Kind::kSpeedLimit:
        return chance(3) ? SpeedLimit{time(), {}} : SpeedLimit{time(), base::Metres{i32(0, 30'000'000)}};
    }
    return Header{};
  }

  sensor::CarSample car() {
    sensor::CarSample car{time(), i32(-2'147'483'648, 2'147'483'647), {}, {}};
    if (chance(2)) car.steering = base::Radians{i32(-15'708, 15'708)};
    if (chance(2)) car.yaw_rate = base::RadiansPerSecond{i32(-1'000'000, 1'000'000)};
    return car;
  }

 private:
  std::int32_t i32(std::int64_t min, std::int64_t max) { return static_cast<std::int32_t>(between(min, max)); }
  std::uint32_t u32() { return static_cast<std::uint32_t>(between(0, 4'294'967'295)); }
  std::uint8_t u8() { return static_cast<std::uint8_t>(between(0, 255)); }
  base::Time time() { return {between(0, 9'999'990'000)}; }
  base::Metres position() { return {i32(-10'000'000, 10'000'000)}; }
  base::Radians heading() { return {i32(-10'000'000, 10'000'000)}; }
  base::Ratio2 confidence() { return {i32(0, 100)}; }
  sensor::Rgb rgb() { return {u8(), u8(), u8()}; }

  sensor::CameraIntrinsics camera() {
    sensor::CameraIntrinsics camera;
    camera.model = text();
    camera.width = static_cast<std::uint16_t>(between(2, 32'767));
    camera.height = static_cast<std::uint16_t>(between(2, 32'767));
    camera.fx = {i32(1, 3'276'700)};
    camera.fy = {i32(1, 3'276'700)};
    camera.cx = {i32(-3'276'800, 3'276'700)};
    camera.cy = {i32(-3'276'800, 3'276'700)};
    camera.k1 = {i32(-100'000, 100'000)};
    camera.mount = {position(), position(), position(), heading(), std::nullopt};
    if (chance(2)) camera.mount.pitch = base::Radians{i32(-15'708, 15'708)};
    camera.latency = {between(0, 100'000)};
    return camera;
  }

  /// Of every size; the largest values in all of 16 blobs would not fit into a line, so those stay below 10000 px.
  sensor::BlobFrame frame() {
    sensor::BlobFrame frame{time(), u32(), {}};
    const std::size_t count = chance(3) ? sensor::kMaxBlobs : below(sensor::kMaxBlobs + 1);
    const std::int64_t most = count > 8 ? 9'999 : 32'767;
    const std::int64_t least = count > 8 ? 0 : -32'768;
    const bool tracks = count <= 8 && chance(2);
    for (std::size_t i = 0; i < count; ++i) {
      if (!frame.blobs.push_back(blob(most, most, least))) break;
      if (tracks && !chance(3)) frame.blobs[i].track = static_cast<std::uint16_t>(between(0, 65'535));
    }
    return frame;
  }

  SectorReport sectors() {
    SectorReport report{time(), {}};
    for (std::size_t i = below(SectorReport::kMax + 1); i > 0; --i) {
      SectorReport::Sector sector;
      if (chance(2)) sector.distance = base::Metres{i32(0, 30'000'000)};
      if (!report.sectors.push_back(sector)) break;
    }
    return report;
  }

  WayReport ways() {
    WayReport report{time(), {}};
    for (std::size_t i = below(WayReport::kMax + 1); i > 0; --i) {
      const WayReport::Way way{static_cast<WayMotion>(below(3)),
                               {i32(-10'000, 10'000)},
                               {i32(0, 30'000'000)},
                               {i32(0, 30'000'000)},
                               static_cast<WayEnd>(below(3))};
      if (!report.ways.push_back(way)) break;
    }
    return report;
  }

  ObjectReport object() {
    ObjectReport object{time(),
                        u32(),
                        u8(),
                        u32(),
                        position(),
                        position(),
                        {},
                        position(),
                        position(),
                        heading(),
                        {},
                        confidence(),
                        static_cast<ObjectState>(below(3))};
    object.radius = {i32(0, 10'000'000)};
    object.distance = {i32(0, 30'000'000)};
    return object;
  }

  AlertReport alert() {
    if (chance(5)) return {time(), AlertLevel::kBlind, u32(), u8(), {}, {}, {}, {}};
    AlertReport alert{time(),      static_cast<AlertLevel>(below(4)), u32(), u8(), heading(), {i32(0, 30'000'000)}, {},
                      confidence()};
    if (chance(2)) alert.ttc = base::Duration{between(0, 9'999'990'000)};
    return alert;
  }

  std::mt19937_64 bits_;
};

}  // namespace fencepost::record
