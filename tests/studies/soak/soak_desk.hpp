// A robot that drives for hours: its sensors are fed piece by piece, its console is a string.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "host/replay/log_sensors.hpp"
#include "tests/firmware/loop/desk.hpp"
#include "tests/studies/soak/course.hpp"

namespace fencepost::test {

template <class Profile>
class SoakDesk {
 public:
  /// Clock and frame counter begin here.
  SoakDesk(base::Time start, std::uint32_t first_frame) : now_(start), frame_(first_frame) {
    loop_.pipeline().start_run(header_);
  }

  void set_up(const host::Scene& scene) {
    loop_.pipeline().set_camera(scene.camera);
    for (std::uint8_t id = 1; id <= 3; ++id) {
      loop_.pipeline().set_signature({id, {}, sensor::Text("colour " + std::to_string(id))});
    }
  }

  /// One turn a millisecond; `every_turn` may type.
  template <class EveryTurn>
  void drive(const Piece& piece, EveryTurn&& every_turn) {
    const base::Time start = now_;
    for (const Input& input : piece.inputs) {
      if (const auto* sample = std::get_if<sensor::OdometrySample>(&input)) {
        turn_until(start + (sample->t - base::Time{}), every_turn);
        sensor::OdometrySample shifted = *sample;
        shifted.t = now_;
        odometry_.offer(shifted);
        ++odometry_offered_;
      } else {
        const auto& frame = std::get<sensor::BlobFrame>(input);
        turn_until(start + (frame.t - base::Time{}), every_turn);
        sensor::BlobFrame shifted = frame;
        shifted.t = now_;
        shifted.frame = frame_++;
        camera_.offer(shifted);
        ++frames_offered_;
      }
      one_turn();
    }
    turn_until(start + piece.length, every_turn);
  }
  void drive(const Piece& piece) {
    drive(piece, [] {});
  }

  void type(std::string_view text) { link.type(text); }
  /// Types a command, waits until it is answered and the queue is empty. No time passes for the sensors.
  void obey(std::string_view command) {
    link.type(command);
    drain();
  }
  void drain() {
    const std::size_t speed = std::exchange(link.bytes_a_turn, 10'000);
    int silent = 0;
    while (silent < 3) {
      one_turn();
      const bool busy = !link.read_all() || loop_.pipeline().testing() || memory().console.answer.pending() ||
                        memory().console.input.front() || !memory().output.waiting().empty();
      silent = busy ? 0 : silent + 1;
    }
    link.bytes_a_turn = speed;
  }

  [[nodiscard]] loop::Memory<Profile>& memory() { return *memory_; }
  [[nodiscard]] base::Time now() const { return now_; }
  [[nodiscard]] std::uint32_t next_frame() const { return frame_; }
  /// Every frame that came is used, refused, rejected or still waits. `bad_records`: typed ones that were rejected,
  /// too.
  [[nodiscard]] bool frames_add_up(std::uint64_t bad_records) const {
    const console::Counters& counters = memory_->counters;
    const std::uint64_t known = std::uint64_t{counters.frames} + counters.refused_in_all() + counters.rejected +
                                memory_->waiting.size() - bad_records;
    return known == frames_offered_;
  }
  [[nodiscard]] std::uint64_t frames_offered() const { return frames_offered_; }
  [[nodiscard]] std::uint64_t odometry_offered() const { return odometry_offered_; }

  DeskLink link;

 private:
  template <class EveryTurn>
  void turn_until(base::Time t, EveryTurn&& every_turn) {
    while (now_ < t) {
      every_turn();
      one_turn();
      now_ = now_ + base::milliseconds(1);
    }
  }
  void one_turn() {
    link.next_turn();
    loop_.step(now_);
  }

  record::Header header_{1, "fencepost", "0.1.0", "soak", Profile::kName};
  base::Time now_;
  std::uint32_t frame_;
  std::uint64_t frames_offered_ = 0;
  std::uint64_t odometry_offered_ = 0;
  std::unique_ptr<loop::Memory<Profile>> memory_ = std::make_unique<loop::Memory<Profile>>();
  host::LogCamera camera_;
  host::LogOdometry odometry_;
  loop::Loop<Profile, host::LogCamera, host::LogOdometry, DeskLink> loop_{*memory_, camera_, odometry_, link,
                                                                          console::Mode::kLog};
};

}  // namespace fencepost::test
