// Alerts on grids so coarse that they often meet a bound exactly, see tests/firmware/recon/sweep.hpp.
#include <vector>

#include "firmware/alert/free_ways.hpp"
#include "firmware/alert/looming.hpp"
#include "firmware/alert/sectors.hpp"
#include "firmware/alert/sight.hpp"
#include "firmware/config/profile.hpp"
#include "tests/firmware/alert/box_outline.hpp"
#include "tests/firmware/alert/known_floor.hpp"
#include "tests/firmware/recon/guard/flat_world.hpp"
#include "tests/firmware/recon/sweep.hpp"

namespace fencepost::test {
namespace {

using alert::kStanding;
using alert::kSurelyMoving;
using alert::kSurelyTurning;
using record::AlertLevel;

const alert::AlertRules kRules{config::Settings{}};

alert::RobotPath any_path(Draw& draw) {
  alert::RobotPath path;
  path.motion = {draw.of({0.0F, kStanding, -kStanding, kSurelyMoving, -kSurelyMoving, 0.03125F, 0.125F, 0.25F, -0.25F}),
                 draw.of({0.0F, 0.0F, kSurelyTurning, -kSurelyTurning, alert::kSpinning, 0.0625F, 0.5F, -0.5F, 1.0F})};
  path.body_radius = 0.125F;
  path.half_width = draw.of({0.1875F, 0.25F});
  path.front = draw.of({0.0F, 0.0625F, 0.25F, 0.5F});
  path.rear = draw.of({0.0F, 0.0625F, 0.25F, 0.5F});
  path.last = {draw.coin(), draw.coin()};
  return path;
}

AlertLevel any_level(Draw& draw) { return static_cast<AlertLevel>(draw.between(0, 3)); }

recon::guard::Front any_front(Draw& draw) {
  const auto at = [&](int low) {
    return static_cast<std::int16_t>(draw.coin() ? 50 * draw.between(low, 20) : draw.of({0, 250, 262, 263, 500, 501}));
  };
  const auto frames = draw.of<std::uint8_t>({1, 2, 4, 0xFF});
  return {at(-6), static_cast<std::int16_t>(at(-10) / 2), frames, draw.of<std::uint8_t>({0, 9, 60}),
          0,      draw.between<std::uint8_t>(1, 3)};
}

TEST(AlertSweep, OfAnObstacle) {
  Draw draw(1);
  Sweep sweep;
  for (int i = 0; i < 20'000; ++i) {
    const alert::RobotPath path = any_path(draw);
    alert::Obstacle obstacle;
    obstacle.known = !draw.one_in(8);
    obstacle.toward = {draw.steps(-4, 8, 0.125F), draw.steps(-3, 3, 0.125F)};
    obstacle.distance = draw.steps(0, 17, 0.0625F);
    obstacle.cut_off = draw.coin();
    obstacle.guessed = draw.coin();
    obstacle.unbacked = draw.one_in(4);
    obstacle.overhang = draw.of({0.0F, 0.0F, 0.125F});
    if (!draw.one_in(4)) obstacle.in_path = alert::InPath{draw.of({0.0F, 0.015625F, 0.5F})};
    alert::set_closing(path, obstacle);
    sweep.tell("closing", obstacle.closing);
    sweep.tell("speed", obstacle.closing_speed);
    sweep.tell("ttc", obstacle.ttc);
    sweep.tell("way", alert::way_to(path, obstacle, 0.5F));
    sweep.tell("level", alert::level_for(obstacle, kRules, draw.of({1.0F, alert::kHysteresis})));
    sweep.tell("limit", alert::stopping_speed(obstacle, path, kRules));
  }
  expect_said(sweep, {"closing 8740 a18711ba", "speed 16429 0a6e3c54", "ttc 6347 4b0707a6", "way 12623 efee205f",
                      "level 14255 b12741d4", "limit 16468 6a98f17d"});
}

TEST(AlertSweep, OfWhatIsInForce) {
  Draw draw(2);
  Sweep sweep;
  for (int run = 0; run < 300; ++run) {
    alert::AlertState state;
    base::Time now{10'000};
    record::AlertReport report;
    for (int i = 0; i < 50; ++i) {
      alert::FrontAhead front;
      front.due = any_level(draw);
      front.held = std::max(front.due, any_level(draw));
      const auto level = draw.coin() ? alert::judge(state, front, any_level(draw), kRules, now)
                                     : alert::follow(state, front.due, front.held, kRules, now);
      sweep.tell("level", level ? 1 + static_cast<int>(*level) : 0);
      sweep.tell("in force", state.level);
      report.level = state.level;
      report.distance = {100 * draw.between(20, 24)};
      sweep.tell("new", alert::is_new(state, report));
      now = now + base::milliseconds(draw.of({20, 100, 100, 200, 300, 1'000}));
    }
  }
  expect_said(sweep, {"level 7984 76a9ba05", "in force 14546 bc4dcd3e", "new 8685 3937b24f"});
}

void tell(Sweep& sweep, const alert::FrontAhead& front) {
  sweep.tell("due", front.due);
  sweep.tell("held", front.held);
  sweep.tell("something", front.something);
  sweep.tell("limit", front.speed);
  sweep.tell("signature", front.signature);
  sweep.tell("confidence", front.confidence);
  sweep.tell("x", front.nearest.known ? front.nearest.toward.x() : -1.0F);
  sweep.tell("ttc", front.nearest.ttc);
}

TEST(AlertSweep, OfFronts) {
  Draw draw(3);
  Sweep sweep;
  alert::FrontAhead before;
  for (int i = 0; i < 20'000; ++i) {
    std::vector<recon::guard::Front> fronts(draw.between<std::size_t>(0, 6));
    for (recon::guard::Front& front : fronts) front = any_front(draw);
    const alert::RobotPlace robot(pose_at(0, draw.of({0.0, 0.0, 0.1}), 0));
    const alert::FrontAhead front = see_fronts(fronts, {}, robot, any_path(draw), kRules);
    tell(sweep, front);
    tell(sweep, more_urgent(before, front));
    before = front;
    const recon::Vec2 place{draw.steps(0, 4, 0.125F), draw.steps(-2, 2, 0.125F)};
    sweep.tell("within", alert::front_within(fronts, {}, robot, place, draw.steps(0, 4, 0.05F)));
  }
  expect_said(sweep, {"due 15778 bbaa7387", "held 17033 430e3927", "something 15024 6d2f6e40", "limit 29474 93aaa1f2",
                      "signature 30563 ef747477", "confidence 30563 d5d975b6", "x 35511 d8edbf9d", "ttc 10825 de50d199",
                      "within 1618 9375d831"});
}

TEST(AlertSweep, OfSweptFloor) {
  Draw draw(4);
  Sweep sweep;
  for (int i = 0; i < 1'000; ++i) {
    const alert::RobotPath path = any_path(draw);
    const alert::SweptArea points(path, draw.of({0.0F, 0.03125F}));
    const alert::SweptByBody discs(path);
    sweep.tell("overhang", discs.overhang({1, 0}) + 4 * discs.overhang({0, 0}));
    for (int k = 0; k < 100; ++k) {
      const recon::Vec2 at{draw.steps(-20, 20, 0.03125F), draw.steps(-20, 20, 0.03125F)};
      sweep.tell("point", points.contains(static_cast<int>(1000 * at.x()), static_cast<int>(1000 * at.y())));
      sweep.tell("disc", discs.touches(at, draw.of({0.0F, 0.0625F, 0.5F})));
    }
  }
  expect_said(sweep, {"overhang 900 e9432617", "point 34468 c9ab9bb6", "disc 56802 945b268a"});
}

// Of 0.28 of the distance, from directions that need no trigonometry.
void see_all_around(recon::ObjectCore& object, const recon::Vec2& center, float away) {
  object.id = 1;
  object.confirmed = true;
  for (const recon::Vec2& side : {recon::Vec2{1, 0}, {0.6F, 0.8F}, {0, 1}, {-0.8F, 0.6F}, {-1, 0}, {0.6F, -0.8F}}) {
    recon::Sighting sighting;
    sighting.axis = sighting.center = side;
    sighting.lens = center - away * side;
    sighting.left = {recon::rotated(side, {0.96F, 0.28F}), recon::End::kSeen};
    sighting.right = {recon::rotated(side, {0.96F, -0.28F}), recon::End::kSeen};
    sighting.focal = 256;
    object.cylinder.add(sighting, {}, 1, {});
    object.cylinder.solve(sighting.lens, side, {});
  }
  ASSERT_TRUE(object.cylinder.estimate().ok());
}

TEST(AlertSweep, OfSectorsAndWays) {
  Draw draw(5);
  Sweep sweep;
  std::vector<recon::Object<config::Small>> objects(6);
  for (std::size_t k = 0; k < objects.size(); ++k) {
    const recon::Vec2 center{0.625F + 0.1875F * static_cast<float>(k), 0.25F * static_cast<float>(k) - 0.5F};
    see_all_around(objects[k], center, 0.25F + 0.25F * static_cast<float>(k % 3));
    const BoxOutline box(0.125F, 0.125F + 0.25F * static_cast<float>(k), 0.004F);
    if (k % 2 == 0) box.put_into(objects[k].hybrid(), recon::moved({}, center));
  }
  for (int i = 0; i < 400; ++i) {
    const recon::Vec2 at{draw.steps(-4, 12, 0.0625F), draw.steps(-6, 6, 0.0625F)};
    const double degrees = 15 * draw.between(-12, 12);
    const recon::MapPose robot = pose_at(double{at.x()}, double{at.y()}, kDegree * degrees);
    const double also = draw.of({90.0, -45.0, 180.0});
    const recon::guard::SeenFloor floor = floor_seen(draw.coin() ? robot : kHome, {0, 45, also});
    std::vector<recon::guard::Front> fronts(draw.between<std::size_t>(0, 4));
    for (recon::guard::Front& front : fronts) front = any_front(draw);
    const alert::RobotPath path = any_path(draw);
    alert::Sectors sectors(floor, robot, 50 * draw.between(2, 4));
    alert::FreeWays ways(path);
    const alert::RobotPlace place(robot);
    sectors.add(fronts, {});
    ways.add(fronts, {}, place);
    for (std::size_t k = draw.between<std::size_t>(0, 2); k < objects.size(); k += 3) {
      sectors.add(objects[k], place);
      ways.add(objects[k], place, static_cast<alert::PassingSide>(draw.between(0, 2)));
    }
    for (std::size_t k = 0; k < alert::kSectors; ++k) sweep.tell("range", sectors.range(k).value_or(-1));
    for (std::size_t k = 0; k < alert::FreeWays::kWays; ++k) {
      const auto way = ways.way(k, floor, place, kRules);
      sweep.tell("free", way.free.raw);
      sweep.tell("speed", way.speed.raw);
      sweep.tell("end", way.end);
    }
  }
  expect_said(sweep, {"range 13968 692788d1", "free 1885 f3906169", "speed 1332 c18a8db0", "end 3418 d7ddabf2"});
}

TEST(AlertSweep, OfInputs) {
  Draw draw(6);
  Sweep sweep;
  const recon::CameraModel camera = recon::make_camera_model(level_pixy2());
  for (int run = 0; run < 300; ++run) {
    alert::Sight sight;
    base::Time t{10'000};
    sight.start(t);
    sensor::OdometrySample told{t, {}, {}, {}};
    double x = 0;
    for (int i = 0; i < 60; ++i) {
      t = t + base::milliseconds(draw.of({20, 20, 50, 100, 200, 270}));
      told.t = t;
      told.x.raw += draw.of({0, 0, 100, 300, 1'500, 2'000});
      told.heading.raw += draw.of({0, 0, 50, 500, -6'667, 13'334});
      if (!draw.one_in(4)) sight.odometry_came(told);
      if (!draw.one_in(3)) x += draw.of({0.0, 0.0, 0.01, 0.1});
      if (!draw.one_in(4)) {
        sensor::BlobFrame frame = flat_view({{0.9 + (run % 3), -0.2, 0.2, 1}}, x > 0.8 ? 9 : x, 0, 0, 1);
        frame.t = t;
        sight.frame_came(t);
        if (!draw.one_in(8)) sight.frame_used(recon::make_waiting(frame, 0), camera, recon::to_map_pose(told));
      }
      const base::Time now = t + base::milliseconds(draw.of({0, 0, 270, 500, 1'000}));
      sweep.tell("blind", sight.blindness(now, draw.coin()));
      sweep.tell("camera", sight.camera_state(now, draw.coin()));
      sweep.tell("odometry", sight.odometry_state(now, draw.coin()));
    }
  }
  expect_said(sweep, {"blind 9699 1e606d64", "camera 17910 f32695bf", "odometry 17898 ff3ed8c3"});
}

}  // namespace
}  // namespace fencepost::test
