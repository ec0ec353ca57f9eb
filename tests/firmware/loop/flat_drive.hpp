// A robot in a flat world, through the whole pipeline, and what it says.
#pragma once

#include <array>
#include <cmath>
#include <deque>
#include <map>
#include <memory>
#include <vector>

#include "firmware/loop/pipeline.hpp"
#include "firmware/record/stream_reader.hpp"
#include "tests/firmware/level_pixy2.hpp"
#include "tests/firmware/recon/guard/flat_world.hpp"

namespace fencepost::test {

struct Alerts {
  std::vector<record::AlertReport> all;
  std::vector<record::Heartbeat> beats;
  std::vector<record::SpeedLimit> limits;
  void accept(const record::AlertReport& report) { all.push_back(report); }
  void accept(const record::Heartbeat& beat) { beats.push_back(beat); }
  void accept(const record::SpeedLimit& limit) { limits.push_back(limit); }
  template <class Record>
  void accept(const Record& /*not asked for*/) {}
};

/// A robot in a flat world. Odometry at 100 samples a second, frames at `rate`.
template <class Base = config::Small>
class Drive {
 public:
  using Profile = loop::Journaled<Base, 64 * 1024>;

  explicit Drive(double rate = 10) : rate_(rate) {
    memory->journal.start();
    pipeline.start_run(header_);
    pipeline.set_camera(level_pixy2());
  }

  /// For `seconds` at `speed` m/s along x, turning at `turn` rad/s.
  void go(double seconds, double speed, const std::vector<FlatFront>& world, double turn = 0) {
    const auto steps = static_cast<int>(std::lround(seconds * 100));
    for (int i = 0; i < steps; ++i) {
      t += 0.01;
      heading += 0.01 * turn;
      x += 0.01 * speed * std::cos(heading);
      pipeline.accept(sensor::OdometrySample{
          base::Time::nearest(t), base::Metres::nearest(x), {}, base::Radians::nearest(heading)});
      if (t - last_frame_ > 1 / rate_ - 1e-6) {
        last_frame_ = t;
        on_their_way_.push_back(flat_view(world, x, 0, t + 0.05, number_++));
      }
      while (!on_their_way_.empty() && on_their_way_.front().t.to_double() < t + 0.005) {
        pipeline.accept(on_their_way_.front());
        on_their_way_.pop_front();
      }
      while (pipeline.place_next_frame()) {
      }
      pipeline.watch_without_frames();
      const std::span<const char> lines = memory->journal.waiting();
      reader_.push({lines.data(), lines.size()}, alerts);
      memory->journal.taken(lines.size());
    }
  }

  /// The last word about each id; clear for those that were never named.
  [[nodiscard]] record::AlertLevel level_of(std::uint32_t id) const {
    record::AlertLevel level = record::AlertLevel::kClear;
    for (const record::AlertReport& alert : alerts.all) {
      if (alert.id == id) level = alert.level;
    }
    return level;
  }
  [[nodiscard]] record::AlertLevel highest() const {
    std::map<std::uint32_t, record::AlertLevel> last;
    for (const record::AlertReport& alert : alerts.all) last[alert.id] = alert.level;
    record::AlertLevel level = record::AlertLevel::kClear;
    for (const auto& [id, said] : last) level = std::max(level, said);
    return level;
  }

  std::unique_ptr<loop::Memory<Profile>> memory = std::make_unique<loop::Memory<Profile>>();
  loop::Pipeline<Profile> pipeline{*memory, console::Mode::kQuiet};
  Alerts alerts;
  double t = 0;
  double x = 0;
  double heading = 0;

 private:
  double rate_;
  double last_frame_ = 0;
  std::deque<sensor::BlobFrame> on_their_way_;
  std::uint32_t number_ = 0;
  record::Header header_{1, "fencepost", "0.0.0", "test", Base::kName};
  std::array<char, record::StreamReader::kBuffer> buffer_{};
  record::StreamReader reader_{buffer_};
};

}  // namespace fencepost::test
