// The loop of the robot: two sensors and one console. Nothing in here waits.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "firmware/loop/console.hpp"
#include "firmware/loop/ranged_odometry.hpp"
#include "hal/bus/byte_link.hpp"
#include "hal/sensor/sources.hpp"

namespace fencepost::loop {

/// A byte on the link is a char in the queue.
inline std::span<const std::uint8_t> as_octets(std::span<const char> text) {
  return {static_cast<const std::uint8_t*>(static_cast<const void*>(text.data())), text.size()};
}

template <class Profile, sensor::BlobCamera Camera, sensor::OdometrySource Odometry, bus::ByteLink Link>
class Loop {
 public:
  Loop(Memory<Profile>& memory, Camera& camera, Odometry& odometry, Link& link, console::Mode mode,
       const CannedStream& canned = canned_stream<Profile>())
      : pipeline_(memory, mode), console_(pipeline_, canned), camera_(camera), odometry_(odometry), link_(link) {}
  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;
  ~Loop() = default;

  /// One turn; `now` is the robot's clock. All effects follow from each input alone, never from the number of inputs in
  /// one turn. A replay, which has one input a turn, therefore does the same.
  void step(base::Time now) {
    if (poll_odometry(now)) process(now, odometry_);
    if (poll_camera(now)) process(now, camera_);
    listen(now);
    pass_time(now);
    pipeline_.reporter().calibration();
    send_link_states(now);
    console_.draw_again(now);
    console_.send_answer(links());
    flush();
  }

  /// Appended to the answer of `version`; must outlive this.
  void set_note(std::string_view note) { console_.set_note(note); }
  /// See Console.
  void press_button() { console_.press_button(); }
  [[nodiscard]] Pipeline<Profile>& pipeline() { return pipeline_; }
  [[nodiscard]] const Pipeline<Profile>& pipeline() const { return pipeline_; }
  [[nodiscard]] const RangedOdometry<Odometry>& odometry() const { return odometry_; }
  [[nodiscard]] console::Links links() const { return {camera_.link(), odometry_.link()}; }

 private:
  /// Lines of the console that one turn handles; a longer burst waits in its buffer.
  static constexpr int kLinesPerTurn = 4;

  bool poll_odometry(base::Time now) {
    const base::Result<sensor::OdometrySample> sample = odometry_.poll(now);
    if (sample) pipeline_.accept(*sample);
    return sample.ok();
  }

  bool poll_camera(base::Time now) {
    const base::Result<sensor::BlobFrame> frame = camera_.poll(now);
    if (frame) pipeline_.accept(*frame);
    pipeline_.memory().counters.blobs_dropped = camera_.dropped();
    return frame.ok();
  }

  void listen(base::Time now) {
    if (pipeline_.testing()) {
      if (console_.feed_selftest()) process();
      return;
    }
    read();
    for (int i = 0; i < kLinesPerTurn && !pipeline_.testing(); ++i) {
      const auto handled = console_.handle_line(now);
      if (handled == Console<Profile>::Handled::kNothing) return;
      if (handled == Console<Profile>::Handled::kInput && pipeline_.used_input()) process();
    }
  }

  void send_link_states(base::Time now) {
    LinkWatches& links = pipeline_.memory().links;
    pipeline_.reporter().link(links.camera, camera_, "camera", now);
    pipeline_.reporter().link(links.odometry, odometry_, "odometry", now);
  }

  // As much as the console's buffer holds.
  void read() {
    const std::span<std::uint8_t> room = console_.room();
    if (room.empty()) return;
    const base::Result<std::size_t> count = link_.read(room);
    if (count) console_.filled(*count);
  }

  // Time passes by this robot's clock, also before the first input. If all inputs come over the console, it is the
  // sender's time, which stops while the sender is silent.
  void pass_time(base::Time now) {
    const bool stamped = sensor::stamped_here(camera_) || sensor::stamped_here(odometry_);
    if (stamped && !pipeline_.has_clock()) pipeline_.set_clock(now);
    pipeline_.pass_time(now);
  }

  // A refused input has no effects, for a replay does not have it.
  template <class Source>
  void process(base::Time now, const Source& source) {
    if (!pipeline_.used_input()) return;
    process();
    if (sensor::stamped_here(source)) pipeline_.set_clock(now);
  }
  // The effects of one input. The queue is flushed between them, so that it need not hold all that they emit.
  void process() {
    flush();
    while (pipeline_.place_next_frame()) flush();
    pipeline_.watch_without_frames();
    pipeline_.send_status();
    flush();
  }

  // As much as the link has room for now.
  void flush() {
    auto& output = pipeline_.memory().output;
    if (output.waiting().empty()) return;
    const base::Result<std::size_t> taken = link_.write(as_octets(output.waiting()));
    if (taken) output.taken(*taken);
  }

  Pipeline<Profile> pipeline_;
  Console<Profile> console_;
  Camera& camera_;
  RangedOdometry<Odometry> odometry_;
  Link& link_;
};

}  // namespace fencepost::loop
