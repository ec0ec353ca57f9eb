// The one owner of memory: everything that the loop remembers, in one static object. Too small a part therefore fails
// at compile time, on the desk, and not after ten minutes in front of a class.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <type_traits>

#include "drivers/odometry/car_drive.hpp"
#include "firmware/alert/camera_doubt.hpp"
#include "firmware/alert/free_ways.hpp"
#include "firmware/alert/front_alert.hpp"
#include "firmware/alert/looming.hpp"
#include "firmware/alert/sectors.hpp"
#include "firmware/alert/sight.hpp"
#include "firmware/config/devices.hpp"
#include "firmware/config/profile.hpp"
#include "firmware/config/settings.hpp"
#include "firmware/console/console_state.hpp"
#include "firmware/console/counters.hpp"
#include "firmware/console/trail.hpp"
#include "firmware/loop/alert_listener.hpp"
#include "firmware/loop/journal.hpp"
#include "firmware/loop/link_watch.hpp"
#include "firmware/loop/output_queue.hpp"
#include "firmware/recon/guard/seen_floor.hpp"
#include "firmware/recon/map.hpp"
#include "firmware/recon/models/next_view.hpp"
#include "firmware/record/records.hpp"
#include "hal/sensor/camera.hpp"

namespace fencepost::loop {

/// The last report of one object; reset when it ends.
struct ReportState {
  bool sent = false;
  record::ObjectState state = record::ObjectState::kTentative;
  base::Stamp at;
};

/// The calibration in force and the one before it, which frames that still wait may need.
struct Calibration {
  bool known = false;
  std::uint8_t current = 0;
  sensor::CameraIntrinsics intrinsics;
  std::array<recon::CameraModel, 2> models{};
};

/// The clock of the run and what was sent when. Stream times.
struct Run {
  std::optional<base::Time> time;        ///< the latest t of any input
  std::optional<base::Time> last_frame;  ///< t of the latest frame
  const record::Header* header = nullptr;
  alert::Sight sight;
  alert::LastWay last_way;
  std::optional<base::Duration> behind;  ///< of stream time to this robot's clock, if that stamps any input
  base::Stamp watched_at;
  base::Stamp beat_at;  ///< of the last heartbeat
  base::Stamp status_at;
  base::Stamp pose_sent_at;
  base::Stamp calibration_at;
  std::uint8_t next_record = 0;   ///< of the calibration: the next one to send
  bool calibration_sent = false;  ///< all its records are queued
  bool header_due = false;        ///< the header is still to be sent
  bool whole = true;              ///< every input of this run was used in mode log
  bool testing = false;           ///< the inputs are those of the self-test
  bool used = false;              ///< the latest input was
  bool newest = false;            ///< and none before it had a later t
  std::int16_t speed_limit = -1;  ///< mm/s, by the path as it was watched last; negative: not known
};

/// Places of the trail in the console's map: micro has few bytes left.
template <class Profile>
inline constexpr std::size_t kTrailPlaces = Profile::kObjects < 8 ? 6 : 32;

/// The empty type for a profile without room for the floor.
struct NoFloor {};

template <class Profile>
struct Memory {
  Run run;
  recon::Map<Profile> map;
  [[no_unique_address]] std::conditional_t<Profile::kSeesFloor, recon::guard::SeenFloor, NoFloor> floor;
  recon::FrameQueue waiting;
  recon::PoseHistory<Profile::kPoses> poses;
  odometry::CarDrive car;
  Calibration calibration;
  base::FixedVector<record::Signature, Profile::kSignatures> signatures;
  config::Settings settings;
  config::Devices devices;                     ///< that were chosen
  std::uint8_t choices = 0;                    ///< number of choices, modulo 256: its change opens them anew
  const config::DeviceOffer* offer = nullptr;  ///< to choose from; none: they are not chosen here
  recon::MeasurementNoise noise;
  std::array<alert::AlertState, Profile::kObjects> alerts{};
  alert::Looming<Profile::kTracks> looming;
  alert::AlertState front_alert;  ///< without an object: by the guard, by looming, or because the robot is blind
  alert::CameraDoubt camera_doubt;
  std::array<ReportState, Profile::kObjects> reports{};
  console::Counters counters;
  LinkWatches links;
  console::ConsoleState console;
  console::Trail<kTrailPlaces<Profile>> trail;
  OutputQueue<Profile::kOutputBytes> output;
  [[no_unique_address]] Journal<Profile::kJournalBytes> journal;
  [[no_unique_address]] AlertListener<kIsHeard<Profile>> listener;
};

/// The robot's pose in the map, by its latest odometry and the corrections so far. Needs odometry.
template <class Profile>
recon::MapPose robot_pose(const Memory<Profile>& memory) {
  return memory.map.corrected(memory.poses.latest());
}

/// From where to look at the object in that slot next; with some clearance for the robot's body.
template <class Profile>
[[gnu::noinline]] recon::NextView next_view_of(const Memory<Profile>& memory, std::size_t slot) {
  const recon::Object<Profile>& object = memory.map.slots()[slot];
  if (!object.hybrid().ok()) return {};
  const recon::MapPoint origin = object.hybrid().origin;
  base::FixedVector<recon::Disc, Profile::kObjects> others;
  for (const recon::ObjectCore& other : memory.map.slots()) {
    const recon::CylinderEstimate& cylinder = other.cylinder.estimate();
    if (!other.used() || other.id == object.id || !cylinder.ok()) continue;
    static_cast<void>(
        others.push_back({recon::offset_from(origin, recon::moved(other.origin, cylinder.center)), cylinder.radius}));
  }
  const float clearance =
      0.5F * memory.settings.number(config::Key::kRobotWidth) + memory.settings.number(config::Key::kRobotMargin);
  const recon::Vec2 robot = recon::offset_from(origin, robot_pose(memory).position);
  return recon::next_view(object.hybrid().outline(), object.hybrid().clusters, robot, others.view(), clearance);
}

/// The answer of `sectors`, which a planner takes for a lidar's ranges. Needs odometry.
template <class Profile>
requires(Profile::kSeesFloor) [[gnu::noinline]] record::SectorReport sectors_of(const Memory<Profile>& memory) {
  const recon::MapPose odometry = memory.poses.latest();
  const config::Settings& settings = memory.settings;
  const float body = 0.5F * settings.number(config::Key::kRobotWidth) + settings.number(config::Key::kRobotMargin);
  alert::Sectors sectors(memory.floor, odometry,
                         recon::nearest_whole(recon::kMillimetresPerMetre * body, alert::kLongestRange));
  sectors.add(memory.map.guard().fronts(), memory.map.guard().origin());
  const alert::RobotPlace robot(memory.map.corrected(odometry));
  for (const recon::Object<Profile>& object : memory.map.slots()) sectors.add(object, robot);
  record::SectorReport report;
  report.t = memory.run.time.value_or(base::Time{});
  static_assert(alert::kSectors == record::SectorReport::kMax);
  for (std::size_t k = 0; k < alert::kSectors; ++k) {
    record::SectorReport::Sector sector;
    if (const auto range = sectors.range(k)) sector.distance = base::Metres{*range * (base::Metres::kPerUnit / 1000)};
    static_cast<void>(report.sectors.push_back(sector));
  }
  return report;
}

/// The robot's body by its settings; the caller fills in its motion.
inline alert::RobotPath body_of(const config::Settings& settings) {
  alert::RobotPath path;
  path.body_radius = 0.5F * settings.number(config::Key::kRobotWidth);
  path.half_width = path.body_radius + settings.number(config::Key::kRobotMargin);
  path.front = settings.number(config::Key::kRobotFront);
  path.rear = settings.number(config::Key::kRobotRear);
  return path;
}

/// Of `ways_of`: things of every colour may be passed on either side.
inline constexpr auto kPassAnywhere = [](std::uint8_t /*signature*/) { return alert::PassingSide::kAny; };

/// The answer of `ways`. `side_of(signature)`: on which side things of that colour have to be passed. Needs odometry.
template <class Profile, class SideOf>
requires(Profile::kSeesFloor) [[gnu::noinline]] record::WayReport
    ways_of(const Memory<Profile>& memory, const SideOf& side_of) {
  const recon::MapPose pose = memory.poses.latest();
  const alert::RobotPlace odometry(pose);
  const alert::RobotPlace robot(memory.map.corrected(pose));
  alert::FreeWays ways(body_of(memory.settings));
  ways.add(memory.map.guard().fronts(), memory.map.guard().origin(), odometry);
  for (const recon::Object<Profile>& object : memory.map.slots()) ways.add(object, robot, side_of(object.signature));
  const alert::AlertRules rules(memory.settings, memory.camera_doubt.caution());
  record::WayReport report;
  report.t = memory.run.time.value_or(base::Time{});
  for (std::size_t k = 0; k < alert::FreeWays::kWays; ++k) {
    static_cast<void>(report.ways.push_back(ways.way(k, memory.floor, odometry, rules)));
  }
  return report;
}

template <class Profile>
inline constexpr bool kFits = sizeof(Memory<Profile>) <= Profile::kBudget &&
                              sizeof(recon::guard::Guard<Profile::kFronts>) + sizeof(recon::Standing) +
                                      sizeof(alert::AlertState) <=
                                  600 &&
                              sizeof(recon::PoseCorrection<Profile>) <= Profile::kPoseBytes;

/// Lines that one input may put into the logs, at most. First the calibration, what is thought of it, and the input.
/// Then for each frame that waited digest, pose, alerts and reports of the objects. At last alerts without a frame,
/// heartbeat, speed limit, status and links.
template <class Profile>
inline constexpr std::size_t kLinesOfOneInput = [] {
  constexpr std::size_t kCalibration = 2 + Profile::kSignatures + config::kKeys + 1;
  // Clears of the ended, an alert and a report of each object; the guard's alert.
  constexpr std::size_t kOfFrame = 2 + 5 * Profile::kObjects + 1;
  return kCalibration + 1 + recon::kMaxWaitingFrames * kOfFrame + Profile::kObjects + 1 + 6;
}();

static_assert(kFits<config::Micro>);
static_assert(kFits<config::Small>);
static_assert(kFits<config::Full>);

}  // namespace fencepost::loop
