#include "firmware/console/listings.hpp"

#include <array>

#include "firmware/console/reports.hpp"
#include "firmware/console/sentence.hpp"
#include "firmware/console/text.hpp"
#include "firmware/record/decimal.hpp"
#include "hal/base/trig.hpp"

namespace fencepost::console {
namespace {

constexpr std::int32_t kMapUnitsPerTenthMillimetre = recon::kMapUnitsPerMetre / base::Metres::kPerUnit;
constexpr std::int32_t kMicroradiansPerUnit = 1'000'000 / base::Radians::kPerUnit;

base::Metres metres(std::int32_t map_units) {
  return {static_cast<std::int32_t>(divide_rounded(map_units, kMapUnitsPerTenthMillimetre))};
}
// In (-180, 180]: odometry may count whole turns.
std::int64_t compass_degrees(std::int32_t microradians) {
  const std::int64_t degrees =
      whole_degrees({static_cast<std::int32_t>(divide_rounded(microradians, kMicroradiansPerUnit))}) % 360;
  if (degrees > 180) return degrees - 360;
  return degrees <= -180 ? degrees + 360 : degrees;
}

void put_run(Sentence& s, const StatusFacts& facts) {
  s.put("profile ").put(facts.profile).put(", mode ").put(name(facts.mode));
  s.put(", alerts ").put(facts.alerts ? "on" : "off").put(", time ");
  if (!facts.time) {
    s.put("not known yet");
    return;
  }
  s.number(facts.time->raw, base::Time::kDecimals).put(" s");
}

void put_frames(Sentence& s, const Counters& counters) {
  const auto refused = [&](Refusal reason) { return counters.refused[static_cast<std::size_t>(reason)]; };
  s.put("frames used ").number(counters.frames).put(", refused: no_pose ").number(refused(Refusal::kNoPose));
  s.put(", odometry_gap ").number(refused(Refusal::kOdometryGap));
  s.put(", no_camera ").number(refused(Refusal::kNoCamera)).put(", queue ").number(refused(Refusal::kQueue));
}

void put_records(Sentence& s, const Counters& counters) {
  s.put("blobs used ").number(counters.blobs).put(", dropped ").number(counters.blobs_dropped);
  s.put("; odometry ").number(counters.odometry).put("; rejected ").number(counters.rejected);
  s.put("; records dropped ").number(counters.records_dropped);
}

void put_links(Sentence& s, const StatusFacts& facts) {
  s.put("camera link ").put(name(facts.links.camera));
  if (facts.camera != nullptr) {
    s.put(", ").put(facts.camera->model.view()).put(" ");
    s.number(facts.camera->width).put("x").number(facts.camera->height);
  } else {
    s.put(", no calibration ($FPCAM)");
  }
  s.put("; odometry link ").put(name(facts.links.odometry));
}

// Half of the columns by the focal length is the tangent of half the angle, or of a fisheye that half itself.
std::int64_t degrees_across(const sensor::CameraIntrinsics& camera) {
  constexpr float kHalfPerColumn = 50;  // hundredths of a pixel
  const float across = kHalfPerColumn * static_cast<float>(camera.width);
  const auto focal = static_cast<float>(camera.fx.raw);
  const float half = camera.lens == sensor::Lens::kEquidistant ? across / focal : base::atan2_rad(across, focal);
  return static_cast<std::int64_t>(half * 360 / base::kPi + 0.5F);
}

// As the makers write it.
void put_address(Sentence& s, std::uint8_t address) {
  const std::array<char, 2> digits = {record::kLowerHex[address >> 4U], record::kLowerHex[address & 0xFU]};
  s.put(" at 0x").put({digits.data(), digits.size()});
}

void put_port(Sentence& s, const config::DeviceInfo& device, std::string_view line, const bus::PinNames& pins) {
  using config::Port;
  std::string_view names;
  switch (device.port) {
    case Port::kConsole: break;
    case Port::kLine:
      s.put(" at ").number(device.speed).put(" baud");
      names = line;
      break;
    case Port::kTwoWire:
      put_address(s, device.address);
      names = pins.two_wire;
      break;
    case Port::kPins: names = pins.encoders; break;
  }
  if (!names.empty()) s.put(" (").put(names).put(")");
}

// "camera pixy2.1 at 115200 baud (GP4 sends, GP5 receives), lens 80 deg; odometry console".
void put_devices(Sentence& s, const StatusFacts& facts) {
  const config::DeviceInfo& camera = config::info(facts.devices->camera());
  const config::DeviceInfo& odometry = config::info(facts.devices->odometry());
  const bus::PinNames& pins = facts.offer->pins;
  s.put("camera ").put(camera.name);
  put_port(s, camera, pins.line, pins);
  if (facts.camera != nullptr) {
    s.put(", lens ").number(degrees_across(*facts.camera)).put(" deg");
    if (facts.devices->calibration().fx != facts.camera->fx) s.put(" by $FPCAM");
  }
  s.put("; odometry ").put(odometry.name);
  put_port(s, odometry, pins.base, pins);
}

void put_robot(Sentence& s, const StatusFacts& facts) {
  if (!facts.robot) {
    s.put("robot: no odometry yet");
    return;
  }
  s.put("robot x ").metres(metres(facts.robot->position.x)).put(" m, y ").metres(metres(facts.robot->position.y));
  s.put(" m, heading ").number(compass_degrees(facts.robot->heading)).put(" deg");
}

void put_map(Sentence& s, const StatusFacts& facts) {
  s.put("objects ").number(facts.objects).put(" of ").number(facts.capacity);
  s.put(", confirmed ").number(facts.confirmed).put("; digest ").digest(facts.digest);
}

}  // namespace

std::size_t write_status(std::size_t line, const StatusFacts& facts, std::span<char> out) {
  constexpr std::size_t kDevices = 7;
  Sentence s(out);
  if (facts.offer != nullptr && line >= 2) line = line == 2 ? kDevices : line - 1;
  switch (line) {
    case 0: put_run(s, facts); break;
    case 1: put_links(s, facts); break;
    case kDevices: put_devices(s, facts); break;
    case 2: put_frames(s, facts.counters); break;
    case 3: put_records(s, facts.counters); break;
    case 4: put_robot(s, facts); break;
    case 5: put_map(s, facts); break;
    default: return describe_calibration(facts.doubt, out);
  }
  return s.end();
}

std::size_t write_objects_head(std::span<char> out) {
  return Sentence(out).put("  id    name       state     views    x m     y m  radius  dist m  bearing").end();
}

std::size_t write_none(std::string_view what, const StatusFacts& facts, std::span<char> out) {
  Sentence s(out);
  s.put("no ").put(what).put(": ");
  const std::uint32_t refused = facts.counters.refused_in_all();
  if (facts.camera == nullptr) {
    s.put("the camera has no calibration ($FPCAM)");
  } else if (!facts.robot) {
    s.put("no odometry came in");
  } else if (facts.counters.frames == 0 && refused == 0) {
    s.put("no camera frame came in");
  } else {
    s.put("frames used ").number(facts.counters.frames).put(", refused ").number(refused);
  }
  return s.end();
}

std::size_t write_object(char letter, const recon::ObjectCore& object, std::string_view name,
                         const alert::Obstacle& seen, base::Time now, std::span<char> out) {
  constexpr std::size_t kMaxName = 10;
  Sentence s(out);
  s.put({&letter, 1}).put(" ").number(object.id).gap_to(8);
  if (name.empty()) {
    s.put("sig ").number(object.signature);
  } else {
    s.put({name.data(), name.size() < kMaxName ? name.size() : kMaxName});
  }
  s.gap_to(19).put(record::name(state_of(object, now))).number_to(34, object.views);
  if (!object.cylinder.estimate().ok()) {
    return s.put("  no place: ").put(recon::name(object.cylinder.estimate().refusal)).end();
  }
  const record::ObjectReport report = report_object(object, seen, now);
  s.put(" ").metres_to(41, report.x).put(" ").metres_to(49, report.y).put(" ").metres_to(57, report.radius);
  s.put(" ").metres_to(65, report.distance).put("  ").bearing(report.bearing);
  return s.end();
}

std::size_t write_next(const recon::ObjectCore& object, std::string_view name, const recon::NextView& next,
                       recon::MapPoint origin, std::span<char> out) {
  constexpr float kHundred = 100;
  constexpr float kDegrees = 57.2957795F;
  constexpr float kMicro = 1e6F;
  Sentence s(out);
  s.number(object.id).put(" ");
  if (name.empty()) {
    s.put("sig ").number(object.signature);
  } else {
    s.put(name);
  }
  if (next.refusal == recon::NextViewRefusal::kNoOutline) return s.put("  from anywhere: it has no outline yet").end();
  if (next.refusal == recon::NextViewRefusal::kBlocked) return s.put("  nowhere: others stand all around it").end();
  const float bearing = base::atan2_rad(next.toward.y(), next.toward.x());
  const recon::MapPoint place = recon::moved(origin, next.place);
  s.put("  from ").number(compass_degrees(static_cast<std::int32_t>(bearing * kMicro))).put(" deg, ");
  s.number(static_cast<std::int64_t>(next.width * kDegrees + 0.5F)).put(" deg wide, as from x ");
  s.metres(metres(place.x)).put(" m, y ").metres(metres(place.y)).put(" m; may change ");
  return s.number(static_cast<std::int64_t>(next.gain * kHundred + 0.5F)).put(" % of it").end();
}

}  // namespace fencepost::console
