// The state behind the library's object: one robot's memory and pipeline, and its listeners.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/fencepost/convert.hpp"
#include "firmware/loop/alert_listener.hpp"
#include "firmware/loop/motion_permit.hpp"
#include "firmware/loop/pipeline.hpp"
#include "firmware/record/layout.hpp"

namespace fencepost::library {

/// All output is heard before the next input: a queue that holds the calibration, which is sent as a whole, is enough.
template <class Base>
struct Embedded : loop::Heard<Base> {
  static constexpr std::size_t kOutputBytes = Base::kOutputBytes > 2048 ? 3072 : 2048;
};

template <class Profile>
class State {
 public:
  using LogFunction = void (*)(void* context, const char* text, std::size_t size);

  State() : pipeline_(memory_, console::Mode::kText) {
    memory_.console.alerts = false;
    pipeline_.start_run(header_);
  }

  void hear_alerts(typename loop::AlertListener<true>::Function function, void* context) {
    memory_.listener.set(function, context);
  }
  /// nullptr: nobody.
  void hear_log(LogFunction function, void* context) {
    log_ = function;
    log_context_ = context;
    memory_.console.alerts = function != nullptr;
    pipeline_.set_mode(function != nullptr ? console::Mode::kLog : console::Mode::kText);
  }

  template <class Input>
  Answer accept(const Input& input) {
    send_calibration();
    const auto rejected = pipeline_.accept(input);
    if (rejected) return *rejected == record::Reject::kTime ? Answer::kTime : Answer::kRange;
    follow();
    if (input.t > now_) now_ = input.t;
    pipeline_.set_clock(now_);
    return Answer::kTaken;
  }

  void pass(base::Time now) {
    if (now < now_) return;
    now_ = now;
    if (!pipeline_.has_clock()) pipeline_.set_clock(now);
    send_calibration();
    pipeline_.pass_time(now);
    flush();
  }

  [[nodiscard]] record::Heartbeat in_force() const { return pipeline_.in_force(); }
  [[nodiscard]] record::SpeedLimit speed_limit() const { return pipeline_.speed_limit(in_force()); }
  bool may_drive(base::Time now) {
    const record::Heartbeat beat = in_force();
    return permit_.judge(beat, {beat.camera, beat.odometry}, now);
  }
  std::uint32_t next_frame() { return frames_++; }
  void restart() {
    pipeline_.restart();
    frames_ = 0;
    now_ = {};
    permit_ = {};
  }

  [[nodiscard]] loop::Pipeline<Profile>& pipeline() { return pipeline_; }
  [[nodiscard]] const loop::Memory<Profile>& memory() const { return memory_; }

 private:
  // No input is used before its calibration is in the log.
  void send_calibration() {
    while (log_ != nullptr && !memory_.run.calibration_sent) {
      pipeline_.reporter().calibration();
      flush();
    }
  }

  void follow() {
    flush();
    while (pipeline_.place_next_frame()) flush();
    pipeline_.watch_without_frames();
    pipeline_.send_status();
    flush();
  }

  void flush() {
    auto& output = memory_.output;
    const std::span<const char> text = output.waiting();
    if (text.empty()) return;
    if (log_ != nullptr) log_(log_context_, text.data(), text.size());
    output.taken(text.size());
  }

  record::Header header_{record::kStreamFormat, "fencepost", kVersion, "library", Profile::kName};
  loop::Memory<Profile> memory_;
  loop::Pipeline<Profile> pipeline_;
  loop::MotionPermit permit_;
  base::Time now_;  ///< the latest that was given
  std::uint32_t frames_ = 0;
  LogFunction log_ = nullptr;
  void* log_context_ = nullptr;
};

/// The stream's times.
constexpr bool is_time(base::Time t) { return t.raw >= record::kTime.min && t.raw <= record::kTime.max; }

}  // namespace fencepost::library
