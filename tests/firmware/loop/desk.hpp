// A robot whose console is a string: what a test types, and what comes back.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "firmware/loop/loop.hpp"
#include "hal/fake/scripted_source.hpp"
#include "tests/firmware/level_pixy2.hpp"
#include "tests/firmware/record/lines.hpp"

namespace fencepost::test {

/// Gives the typed bytes in chunks, takes at most `bytes_a_turn`.
class DeskLink {
 public:
  base::Result<std::size_t> read(std::span<std::uint8_t> in) {
    const std::size_t count = std::min({in.size(), typed_.size(), chunk});
    if (count == 0) return base::Error::kNotReady;
    std::copy_n(typed_.begin(), count, in.begin());
    typed_.erase(0, count);
    return count;
  }
  base::Result<std::size_t> write(std::span<const std::uint8_t> out) {
    const std::size_t count = std::min(out.size(), budget_);
    if (count == 0) return base::Error::kFull;
    said_.append(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(count));
    budget_ -= count;
    return count;
  }
  void type(std::string_view text) { typed_ += text; }
  void next_turn() { budget_ = bytes_a_turn; }
  [[nodiscard]] bool read_all() const { return typed_.empty(); }
  [[nodiscard]] const std::string& said() const { return said_; }
  std::string take_said() { return std::exchange(said_, {}); }

  std::size_t chunk = 1024;
  std::size_t bytes_a_turn = 1'000'000;

 private:
  std::string typed_;
  std::string said_;
  std::size_t budget_ = 0;
};
static_assert(bus::ByteLink<DeskLink>);

struct Script {
  std::vector<fake::OdometryStep> odometry;
  std::vector<fake::CameraStep> camera;
};

inline sensor::OdometrySample desk_odometry(double t, double x = 0) {
  return {base::Time::nearest(t), base::Metres::nearest(x), {}, {}};
}

/// A post straight ahead, 0.1 m wide, its front 1 m from the origin; seen from (x, 0).
inline sensor::BlobFrame desk_frame(double t, std::uint32_t number, double x = 0) {
  sensor::BlobFrame frame{base::Time::nearest(t), number, {}};
  const double depth = 1 - x;
  sensor::Blob blob;
  blob.signature = 1;
  blob.x1 = static_cast<std::int16_t>(157.5 - 273.6 * 0.05 / depth);
  blob.x2 = static_cast<std::int16_t>(157.5 + 273.6 * 0.05 / depth);
  blob.y1 = 100;
  blob.y2 = static_cast<std::int16_t>(std::min(207.0, 103.5 + 273.6 * 0.12 / depth - 0.5));
  static_cast<void>(frame.blobs.push_back(blob));
  return frame;
}

/// Towards the post at 0.04 m/s, 50 frames a second.
inline Script desk_approach(int frames) {
  Script script;
  for (int i = 0; i < frames; ++i) {
    const double t = 0.02 * i;
    const double x = 0.0008 * i;
    script.odometry.push_back({base::Time::nearest(t), desk_odometry(t, x)});
    script.camera.push_back({base::Time::nearest(t), desk_frame(t, static_cast<std::uint32_t>(i), x)});
  }
  return script;
}

template <class Profile = config::Micro>
class Desk {
 public:
  explicit Desk(console::Mode mode = console::Mode::kText, Script script = {},
                const loop::CannedStream& canned = loop::canned_stream<Profile>())
      : script_(std::move(script)), loop_(*memory_, camera_, odometry_, link, mode, canned) {
    loop_.pipeline().start_run(header);
    loop_.pipeline().set_camera(level_pixy2());
    loop_.pipeline().set_signature({1, {0xd0, 0x20, 0x20}, "red"});
  }

  /// One turn a millisecond.
  void turn(int turns = 1) {
    for (int i = 0; i < turns; ++i) {
      link.next_turn();
      loop_.step(now);
      now = now + base::milliseconds(1);
    }
  }
  /// The robot's output from the first byte of `text` until nothing more comes.
  std::string type(std::string_view text) {
    link.type(text);
    std::string said;
    int silent = 0;
    while (silent < 3) {
      turn();
      const std::string more = link.take_said();
      const bool busy = !more.empty() || !link.read_all() || pipeline().testing() || memory().console.input.front();
      silent = busy ? 0 : silent + 1;
      said += more;
    }
    return said;
  }
  std::string type_line(std::string_view text) { return type(std::string(text) + "\r"); }

  void press_button() { loop_.press_button(); }
  void set_note(std::string_view note) { loop_.set_note(note); }
  loop::Pipeline<Profile>& pipeline() { return loop_.pipeline(); }
  loop::Memory<Profile>& memory() { return *memory_; }

  DeskLink link;
  base::Time now;
  record::Header header{1, "fencepost", "0.1.0", "desk", Profile::kName};

 private:
  Script script_;
  std::unique_ptr<loop::Memory<Profile>> memory_ = std::make_unique<loop::Memory<Profile>>();
  fake::ScriptedCamera camera_{script_.camera};
  fake::ScriptedOdometry odometry_{script_.odometry};
  loop::Loop<Profile, fake::ScriptedCamera, fake::ScriptedOdometry, DeskLink> loop_;
};

}  // namespace fencepost::test
