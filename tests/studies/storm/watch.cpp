#include "tests/studies/storm/watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>
#include <utility>

namespace fencepost::test {
namespace {

using record::AlertLevel;

/// Beyond what firmware/alert/tuning.hpp and loop/motion_permit.hpp promise together: a turn, and the time between two
/// looks.
constexpr base::Duration kBlindAtLast = base::milliseconds(1'500 + 300 + 50);
constexpr base::Duration kNeverBlindBefore = base::milliseconds(100);  // frames wait for odometry, too
constexpr base::Duration kFrozenFor = base::milliseconds(190);
constexpr base::Duration kSlowestImage = base::milliseconds(285);
constexpr base::Duration kSurelyLate = base::milliseconds(210);  // and moved by far meanwhile: known from then on
constexpr int kKnownSlow = 2;
constexpr base::Duration kFrozenAtLast = base::milliseconds(400);  // a quarter more than the slowest image
constexpr base::Duration kRemembered = base::milliseconds(2'000);  // more than any camera's latency
constexpr double kMovedByFar = 8;                                  // px: twice what the guard asks for
constexpr int kBorder = 8;                                         // px
constexpr base::Duration kNextSample = base::milliseconds(60);     // wheels are asked more often
constexpr double kTurn = 6.283185307179586;
constexpr base::Duration kSettled = base::milliseconds(4'000);
constexpr base::Duration kReaction = base::milliseconds(350);
constexpr base::Duration kCableComesBack = base::milliseconds(30'000);
constexpr base::Duration kKeptAway = base::milliseconds(100);
constexpr base::Duration kCatchesUp = base::milliseconds(500);
/// Longest pause between images of a slow camera that sends nothing where it sees nothing: a Pixy, a JeVois.
constexpr base::Duration kImagesWithoutBoxes = base::milliseconds(1'500);
constexpr base::Duration kLinkReported = base::milliseconds(3'000);  // after unplugging it is reported as absent

bool same_boxes(const sensor::BlobFrame& a, const sensor::BlobFrame& b) {
  if (a.blobs.size() != b.blobs.size() || a.blobs.empty()) return false;
  for (std::size_t i = 0; i < a.blobs.size(); ++i) {
    const sensor::Blob& one = a.blobs[i];
    const sensor::Blob& other = b.blobs[i];
    if (std::tie(one.x1, one.x2, one.y1, one.y2, one.signature) !=
        std::tie(other.x1, other.x2, other.y1, other.y2, other.signature)) {
      return false;
    }
  }
  return true;
}

}  // namespace

void Watch::Input::note(base::Time now) {
  if (last && now - *last > kNeverBlindBefore) gap = now;
  last = now;
  ++used;
}

bool Watch::Input::regular(base::Time now) const {
  return used > 20 && now - *last < kNeverBlindBefore && (!gap || now - *gap > kSettled);
}

void Watch::fault(const char* check, base::Time now, const std::string& sentence) {
  if (faults_.size() < kMax) faults_.push_back({check, fmt::format("{:.3f} s: {}", now.to_double(), sentence)});
}

void Watch::look(const StormRobot& robot, const Outside& outside, base::Time now) {
  const std::optional<base::Time> stream = robot.stream_time();
  const bool back = seen_.stream && (!stream || *stream < *seen_.stream);
  if (robot.testing() || back || robot.frames_of_run() < seen_.frames) {
    const console::Counters counters = robot.counters();
    seen_ = Seen(now);
    seen_.counters = counters;
  }
  seen_.stream = stream;
  seen_.frames = robot.frames_of_run();
  // Inputs that lay in buffers meanwhile are stamped when they are read: nobody can know from where they were seen.
  if (now - std::exchange(seen_.looked, now) > kKeptAway) {
    seen_.kept_away = now;
    seen_.oracle = {};
  }
  note_inputs(robot, outside, now);
  check_output(robot, outside, now);
  if (robot.testing()) return;
  check_blind(robot, outside, now);
  check_frozen(robot, now);
  check_stop(robot, now);
  check_links(robot, outside, now);
}

void Watch::note_inputs(const StormRobot& robot, const Outside& outside, base::Time now) {
  const Given& given = robot.given();
  const console::Counters before = std::exchange(seen_.counters, robot.counters());
  const console::Counters& after = seen_.counters;
  const auto queue = static_cast<std::size_t>(console::Refusal::kQueue);
  const bool rejected = after.rejected != before.rejected;
  const bool unused = rejected || after.refused_in_all() != before.refused_in_all();
  if (unused) forget_image(now);
  if (given.odometry && after.odometry != before.odometry) note_sample(*given.odometry, now);
  if (given.frame && after.refused[queue] == before.refused[queue] && !rejected) {
    note_frame(*given.frame, robot.camera(), caught_up(now) && now - outside.camera.held > kCatchesUp, now);
  }
  if (unused) forget_image(now);
}

bool Watch::caught_up(base::Time now) const { return !seen_.kept_away || now - *seen_.kept_away > kCatchesUp; }

// This frame or another was not used: what the guard knows of the image is not known here.
void Watch::forget_image(base::Time now) {
  seen_.strange = now;
  seen_.last_frame.reset();
  seen_.frozen.reset();
  seen_.slow_images = 0;
}

// A box with an end inside the image, and a turn that should have moved that by far more than noise.
void Watch::note_motion(const sensor::BlobFrame& frame, const sensor::CameraIntrinsics& camera, base::Time now) {
  if (seen_.frozen) return;
  if (!seen_.odometry.regular(now)) return seen_.same_from.reset();
  const std::optional<sensor::OdometrySample> exposed = sample_at(frame.t);
  if (!exposed) return;
  if (!seen_.same_from) seen_.same_from = exposed;
  const auto turned_to = [&](const sensor::OdometrySample& sample) {
    return std::remainder((sample.heading - seen_.same_from->heading).to_double(), kTurn);
  };
  // The smaller turn of two samples counts: encoders that report whole degrees make a turn of one.
  const double now_turned = turned_to(*exposed);
  const double before = turned_to(sample_at(frame.t - kNextSample).value_or(*seen_.same_from));
  const double turned = now_turned * before > 0 ? std::min(std::fabs(now_turned), std::fabs(before)) : 0;
  const bool end_inside = std::any_of(frame.blobs.begin(), frame.blobs.end(), [&](const sensor::Blob& blob) {
    return blob.x1 > kBorder || blob.x2 + 1 < camera.width - kBorder;
  });
  const bool should_move = end_inside && turned * camera.fx.to_double() > kMovedByFar;
  if (should_move && frame.t - seen_.same_since > kSurelyLate) seen_.late = true;
  if (should_move && exposed->t - seen_.same_from->t > kFrozenAtLast) seen_.frozen = now;
}

std::optional<sensor::OdometrySample> Watch::sample_at(base::Time t) const {
  const auto after =
      std::find_if(seen_.samples.begin(), seen_.samples.end(), [t](const auto& one) { return one.t > t; });
  if (after == seen_.samples.begin()) return std::nullopt;
  return *std::prev(after);
}

void Watch::note_sample(const sensor::OdometrySample& sample, base::Time now) {
  seen_.samples.push_back(sample);
  while (sample.t - seen_.samples.front().t > kRemembered) seen_.samples.pop_front();
  seen_.odometry.note(now);
  if (const auto& last = seen_.last_sample) {
    const double step = std::hypot((sample.x - last->x).to_double(), (sample.y - last->y).to_double());
    if (step > 0.05 || std::fabs((sample.heading - last->heading).to_double()) > 0.3) seen_.strange = now;
  }
  seen_.last_sample = sample;
  seen_.oracle.take(sample);
}

// An image without boxes says nothing of how often there is a new one.
void Watch::note_change(base::Time t) {
  const base::Duration took = t - seen_.same_since;
  if (seen_.last_frame && !seen_.last_frame->blobs.empty()) {
    if (took <= kSurelyLate || took > kSlowestImage) {
      seen_.slow_images = 0;
    } else {
      const base::Duration next{took.raw * 6 / 5};
      seen_.slow_image = seen_.late ? next : std::min(seen_.slow_image, next);  // the guard may have taken it for late
      if (seen_.late) ++seen_.slow_images;
    }
  }
  seen_.late = false;
}

void Watch::note_frame(const sensor::BlobFrame& frame, const sensor::CameraIntrinsics& camera, bool in_time,
                       base::Time now) {
  seen_.camera.note(now);
  const bool repeated = seen_.last_frame && same_boxes(*seen_.last_frame, frame);  // that is no sighting of its own
  if (!repeated) {
    note_change(frame.t);
    seen_.same_since = frame.t;
    seen_.same_from.reset();
    seen_.frozen.reset();
  }
  note_motion(frame, camera, now);
  // As those of a frozen camera; one that repeats its images is known by the first that is late.
  const base::Duration same = frame.t - seen_.same_since;
  const base::Duration usual = seen_.slow_images < kKnownSlow ? kFrozenFor : std::max(kFrozenFor, seen_.slow_image);
  if (same > std::min(kSlowestImage, usual)) seen_.strange = now;
  seen_.last_frame = frame;
  if (in_time && !repeated) seen_.oracle.take(frame, camera);
}

// While an input is missing, blind or standing still; while all come, neither.
void Watch::check_blind(const StormRobot& robot, const Outside& outside, base::Time now) {
  const bool no_frames = now - seen_.camera.last.value_or(seen_.begun) > kBlindAtLast;
  const bool no_odometry = now - seen_.odometry.last.value_or(seen_.begun) > kBlindAtLast;
  const char* missing = no_frames ? "frames" : "odometry";
  if ((no_frames || no_odometry) && outside.may_drive) {
    fault("blind-pin", now, fmt::format("may drive without {}", missing));
  }
  const bool log_flows = now - outside.choked > kSettled;
  const AlertLevel level = robot.in_force().level;
  if ((no_frames || no_odometry) && level < AlertLevel::kStop && log_flows) {
    fault("not-blind", now, fmt::format("not blind without {}", missing));
  }
  const bool calm = seen_.camera.regular(now) && seen_.odometry.regular(now) && now - seen_.begun > kSettled &&
                    (!seen_.strange || now - *seen_.strange > kSettled);
  if (calm && level == AlertLevel::kBlind) {
    fault("blind-without-reason", now, "blind while frames and odometry come and are used");
  }
}

void Watch::check_frozen(const StormRobot& robot, base::Time now) {
  if (!seen_.frozen || now - *seen_.frozen < kReaction || robot.in_force().level >= AlertLevel::kStop) return;
  fault("not-frozen", now, "no word of an image that stands still while the robot turns");
}

void Watch::check_stop(const StormRobot& robot, base::Time now) {
  if (seen_.oracle.overdue(robot.settings(), now) < kReaction) return;
  if (robot.in_force().level < AlertLevel::kStop) fault("missed-stop", now, "no stop for " + seen_.oracle.what());
}

void Watch::check_output(const StormRobot& robot, const Outside& outside, base::Time now) {
  if (robot.in_force().level < AlertLevel::kStop) {
    seen_.urgent.reset();
  } else if (!seen_.urgent) {
    seen_.urgent = now;
  } else if (now - *seen_.urgent > base::milliseconds(10) && outside.may_drive) {
    fault("pin", now, "may drive at stop or blind");
  }
}

void Watch::check_links(const StormRobot& robot, const Outside& outside, base::Time now) {
  using sensor::LinkState;
  const console::Links links = robot.links();
  const auto check = [&](const Outside::Line& line, base::Time& worked, LinkState state,
                         std::optional<LinkState> reported, const char* name) {
    if (sensor::works(state)) worked = now;
    const base::Duration lasted = now - line.since;
    if (!line.plugged && lasted > base::milliseconds(100) && state != LinkState::kAbsent) {
      fault("link", now, fmt::format("{} is unplugged, and {}", name, sensor::name(state)));
    }
    const bool quiet = line.plugged && now - line.disturbed > kCableComesBack && now - seen_.begun > kCableComesBack;
    if (quiet && now - worked > kImagesWithoutBoxes) {
      fault("link-back", now, fmt::format("{} is {} long after its last fault", name, sensor::name(state)));
    }
    const bool steady = (!line.plugged && lasted > kLinkReported) || quiet;
    const bool settled = now - outside.choked > kSettled && now - seen_.begun > kSettled && caught_up(now);
    if (steady && settled && robot.idle() && reported &&
        (*reported == LinkState::kAbsent) != (state == LinkState::kAbsent)) {
      fault("link-said", now,
            fmt::format("{} is {}, and {} was said", name, sensor::name(state), sensor::name(*reported)));
    }
  };
  check(outside.camera, seen_.camera_worked, links.camera, robot.reported_camera(), "the camera");
  check(outside.wheels, seen_.wheels_worked, links.odometry, robot.reported_odometry(), "the odometry");
}

}  // namespace fencepost::test
