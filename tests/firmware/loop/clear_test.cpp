// An alert ends with its object. Every id that was reported at notice or more gets a clear when it ends, however it
// ends. The object that takes its slot begins afresh.
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <memory>
#include <random>
#include <set>

#include "firmware/record/stream_reader.hpp"
#include "tests/firmware/loop/desk.hpp"

namespace fencepost::test {
namespace {

using recon::EventKind;
using record::AlertLevel;

/// The last word about each id, from the log. The ids are those of objects: the guard's alert ends by itself.
struct LastWord {
  std::map<std::uint32_t, record::AlertReport> reports;
  void accept(const record::AlertReport& report) { reports[report.id] = report; }
  template <class Record>
  void accept(const Record& /*not asked for*/) {}

  [[nodiscard]] std::set<std::uint32_t> in_force() const {
    std::set<std::uint32_t> ids;
    for (const auto& [id, report] : reports) {
      if (id != record::kNoObject && report.level >= AlertLevel::kNotice) ids.insert(id);
    }
    return ids;
  }
};

template <class Base>
class Robot {
 public:
  using Profile = loop::Journaled<Base, 64 * 1024>;

  Robot() {
    memory->journal.start();
    pipeline.start_run(header_);
    pipeline.set_camera(level_pixy2());
  }

  /// A sample of odometry and a frame exposed then.
  void look(double t, double heading, const sensor::BlobFrame& frame) {
    pipeline.accept(sensor::OdometrySample{base::Time::nearest(t), {}, {}, base::Radians::nearest(heading)});
    pipeline.accept(frame);
    while (pipeline.place_next_frame()) note_events();
    pipeline.watch_without_frames();
    const std::span<const char> lines = memory->journal.waiting();
    reader_.push({lines.data(), lines.size()}, word);
    memory->journal.taken(lines.size());
  }
  [[nodiscard]] std::set<std::uint32_t> living() const {
    std::set<std::uint32_t> ids;
    for (const recon::ObjectCore& object : memory->map.slots()) {
      if (object.used()) ids.insert(object.id);
    }
    return ids;
  }
  /// Ids with an alert in force that are no object's any more.
  [[nodiscard]] std::size_t stale() const {
    const std::set<std::uint32_t> ids = living();
    std::size_t count = 0;
    for (const std::uint32_t id : word.in_force()) count += ids.contains(id) ? 0U : 1U;
    return count;
  }

  std::unique_ptr<loop::Memory<Profile>> memory = std::make_unique<loop::Memory<Profile>>();
  loop::Pipeline<Profile> pipeline{*memory, console::Mode::kQuiet};
  LastWord word;
  std::map<EventKind, int> ended_in_force;

 private:
  void note_events() {
    for (const recon::ObjectEvent& event : memory->map.events()) {
      const auto last = word.reports.find(event.id);
      const bool in_force = last != word.reports.end() && last->second.level >= AlertLevel::kNotice;
      if (ends(event.kind) && in_force) ++ended_in_force[event.kind];
    }
  }

  record::Header header_{1, "fencepost", "0.0.0", "test", Base::kName};
  std::array<char, record::StreamReader::kBuffer> buffer_{};
  record::StreamReader reader_{buffer_};
};

sensor::BlobFrame nothing(double t, std::uint32_t number) { return {base::Time::nearest(t), number, {}}; }

// A post was seen five times. Then ten frames a second should show it and do not: its alert ends after 0.5 s, and the
// object is deleted after one.
TEST(Clear, ComesWhenAnObjectIsDeleted) {
  Robot<config::Small> robot;
  std::uint32_t number = 0;
  double t = 0;
  for (int i = 0; i < 6; ++i, t += 0.1) robot.look(t, 0, desk_frame(t + 0.05, number++, 0.5));
  ASSERT_EQ(robot.word.in_force().size(), 1U);
  const record::AlertReport warned = robot.word.reports.rbegin()->second;
  for (int i = 0; i < 30; ++i, t += 0.1) robot.look(t, 0, nothing(t + 0.05, number++));
  ASSERT_TRUE(robot.living().empty());
  const record::AlertReport& last = robot.word.reports.rbegin()->second;
  EXPECT_EQ(last.level, AlertLevel::kClear);
  EXPECT_EQ(last.signature, warned.signature);
  EXPECT_LT(last.confidence.raw, warned.confidence.raw);
  EXPECT_FALSE(last.ttc.has_value());
  EXPECT_NEAR(last.distance.to_double(), warned.distance.to_double(), 0.1) << "where it was last said to be";
}

// Boxes come and go, divide and merge, before a robot that turns from place to place. After each frame the alerts in
// force are those of objects that exist.
template <class Base>
void drive_at_random(std::uint32_t seed, std::map<EventKind, int>& ended) {
  Robot<Base> robot;
  std::mt19937 engine(seed);
  const auto from = [&](int low, int high) {
    return low + static_cast<int>(engine() % static_cast<unsigned>(high - low + 1));
  };
  struct Box {
    int left = 0, width = 0, foot = 0, signature = 0;
  };
  std::vector<Box> boxes;
  double heading = 0;
  std::uint32_t number = 0;
  for (double t = 0; t < 40; t += 0.1, ++number) {
    if (number % 8 == 0) {
      heading += from(0, 2) == 0 ? 1.2 : 0;
      boxes.resize(static_cast<std::size_t>(from(0, 4)));
      for (Box& box : boxes) box = {from(0, 260), from(12, 90), from(150, 200), from(1, 2)};
    }
    sensor::BlobFrame frame = nothing(t + 0.05, number);
    for (const Box& box : boxes) {
      const bool in_two = from(0, 5) == 0;
      const int half = box.width / 2 - 2;
      for (const int left : {box.left, box.left + half + 4}) {
        sensor::Blob blob;
        blob.signature = static_cast<std::uint8_t>(box.signature);
        blob.x1 = static_cast<std::int16_t>(left);
        blob.x2 = static_cast<std::int16_t>(std::min(315, left + (in_two ? half : box.width)));
        blob.y1 = 60;
        blob.y2 = static_cast<std::int16_t>(box.foot);
        static_cast<void>(frame.blobs.push_back(blob));
        if (!in_two) break;
      }
    }
    robot.look(t, heading, frame);
    ASSERT_EQ(robot.stale(), 0U) << "seed " << seed << " at " << t;
  }
  for (const auto& [kind, count] : robot.ended_in_force) ended[kind] += count;
}

TEST(Clear, NoAlertOutlivesItsObjectHoweverThatEnds) {
  std::map<EventKind, int> ended;
  for (std::uint32_t seed = 1; seed <= 40; ++seed) {
    ASSERT_NO_FATAL_FAILURE(drive_at_random<config::Micro>(seed, ended));
    ASSERT_NO_FATAL_FAILURE(drive_at_random<config::Small>(seed, ended));
  }
  for (const EventKind kind : {EventKind::kMerged, EventKind::kDivided, EventKind::kEvicted, EventKind::kDeleted}) {
    EXPECT_GT(ended[kind], 0) << "kind " << static_cast<int>(kind) << " never ended an alert";
  }
}

}  // namespace
}  // namespace fencepost::test
