// A board on the bench: its console, its camera, and somebody who plays scenes to it and reads what it says.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "hal/base/units.hpp"
#include "host/emulate/models/pixy2.hpp"
#include "tests/boards/attached.hpp"
#include "tests/boards/emulator.hpp"
#include "tests/boards/scene_stream.hpp"

namespace fencepost::test {

class Bench {
 public:
  explicit Bench(BoardUnderTest board);

  /// Until `text` has been said since the last call of said() or clear(); false after so many seconds.
  bool await(std::string_view text, double seconds = 10);
  /// Types a line and waits for an answer that holds `expected`.
  bool obey(std::string_view command, std::string_view expected);
  /// All lines, for so long.
  void run(double seconds);
  /// Everything the console has said since clear().
  [[nodiscard]] const std::string& said() const { return said_; }
  void clear() { said_.clear(); }
  /// State of the last record of that link, whenever it was; empty if there was none.
  [[nodiscard]] std::string last_link(std::string_view sensor) const;

  /// Until the board says that its camera works.
  bool await_camera(double seconds = 10);
  /// correct.pose on, if so; it is auto at first.
  bool correct_pose(bool on) { return !on || obey("set correct.pose on", "correct.pose = on"); }
  /// Mode log and a new run; then the calibration.
  bool start_log(const SceneStream& stream);
  /// In the machine's time. `also(seconds)` is called between inputs, and may do harm.
  void play(const SceneStream& stream, const std::function<void(double)>& also = {});
  /// Asks for the status and takes its digest; empty if none came.
  std::string digest();

  /// One input, as the board's sensors bring it.
  void give(const SceneStream::Input& input);
  void give(const sensor::OdometrySample& sample);
  void give(const sensor::BlobFrame& frame);

  [[nodiscard]] Line& console() { return machine_->line(board_.console); }
  [[nodiscard]] Line& line(std::size_t n) { return machine_->line(n); }
  [[nodiscard]] Line& camera_line() { return machine_->line(static_cast<std::size_t>(board_.camera)); }
  [[nodiscard]] bool alive() { return machine_->alive(); }
  /// By the machine's clock.
  [[nodiscard]] double seconds() const { return machine_->seconds(); }
  void stop() { machine_->stop(); }
  /// The camera's cable is pulled, or back.
  void unplug_camera(bool unplugged);
  void unplug_base(bool unplugged) { base_->unplug(unplugged); }
  [[nodiscard]] Line& base_line() { return machine_->line(static_cast<std::size_t>(board_.base)); }
  void pump();

 private:
  [[nodiscard]] base::Time now() const;
  void pump_camera();
  void attach_devices();
  void tell();

  BoardUnderTest board_;
  std::unique_ptr<Machine> machine_;
  emulate::Pixy2 camera_{base::Time{-100'000}};  // has been on for ten seconds
  bool unplugged_ = false;
  std::unique_ptr<Attached> other_camera_;  ///< instead of the Pixy2
  std::unique_ptr<Attached> base_;
  std::string said_;
  std::string all_;  ///< since the start
};

/// The record stream's line, with an empty time: stamped when it arrives.
std::string unstamped(const sensor::OdometrySample& sample);

}  // namespace fencepost::test
