#include "tests/studies/storm/world.hpp"

namespace fencepost::test {

World::World(std::vector<Lap> laps, std::uint64_t order, base::Time begin)
    : laps_(std::move(laps)), order_(order), lap_begun_(begin) {}

base::Time World::when(base::Time of_feed) const { return lap_begun_ + (of_feed - laps_[lap_].feed.begin()); }

emulate::Travel World::travel_at(base::Time now) const {
  if (now < lap_begun_) return before_;
  emulate::Travel travel = laps_[lap_].travel.at(laps_[lap_].feed.begin() + (now - lap_begun_));
  travel.distance += before_.distance;
  travel.heading += before_.heading;
  return travel;
}

void World::next_lap() {
  const Lap& lap = laps_[lap_];
  const emulate::Travel whole = lap.travel.at(lap.feed.end());
  before_.distance += whole.distance;
  before_.heading += whole.heading;
  lap_begun_ = lap_begun_ + lap.length;
  lap_ = static_cast<std::size_t>(order_.whole(0, static_cast<std::int64_t>(laps_.size()) - 1));
  frame_ = pose_ = 0;
}

// Of a pose and a frame of one time the pose goes first: a frame that arrives together with its pose comes after it.
bool World::dispatch_next(base::Time now) {
  const emulate::Feed& feed = laps_[lap_].feed;
  const bool pose = pose_ < feed.poses.size();
  const bool frame = frame_ < feed.frames.size();
  const bool pose_first = pose && (!frame || feed.poses[pose_].t <= feed.frames[frame_].t);
  if (pose_first) {
    const base::Time t = when(feed.poses[pose_].t);
    if (t > now) return false;
    for (FarEnd* device : devices_) device->pose(feed.poses[pose_], t);
    ++pose_;
  } else if (frame) {
    const base::Time t = when(feed.frames[frame_].t);
    if (t > now) return false;
    for (FarEnd* device : devices_) device->see(feed.frames[frame_], t);
    ++frame_;
  } else {
    if (lap_begun_ + laps_[lap_].length > now) return false;
    next_lap();
  }
  return true;
}

void World::advance(base::Time now) {
  while (dispatch_next(now)) continue;
  const emulate::Travel travel = travel_at(now);
  for (FarEnd* device : devices_) device->step(travel, now);
}

}  // namespace fencepost::test
