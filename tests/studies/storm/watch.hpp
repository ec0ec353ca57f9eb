// Looks over the robot's shoulder: after each turn, does its output agree with its inputs?
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "tests/studies/storm/robot.hpp"
#include "tests/studies/storm/stop_oracle.hpp"

namespace fencepost::test {

/// `check`: by which a shrunk run is known to fail as the whole one did.
struct Fault {
  std::string check;
  std::string sentence;
};

/// Facts that the run knows and the robot does not. Times by the robot's clock; of cables: since when they are as they
/// are.
struct Outside {
  struct Line {
    bool plugged = true;
    base::Time since;
    base::Time disturbed;  ///< the end of the last fault on it
    base::Time held;       ///< until then its bytes were, the last time that they were, kept on their way
  };
  Line camera;
  Line wheels;
  base::Time choked;       ///< when the log, or the console, last was slower than it is meant to be
  bool may_drive = false;  ///< the STOP output, as motors see it
};

class Watch {
 public:
  explicit Watch(std::vector<Fault>& faults) : faults_(faults) {}

  /// A robot was switched on.
  void begin(base::Time now) { seen_ = Seen(now); }
  void look(const StormRobot& robot, const Outside& outside, base::Time now);

 private:
  struct Input {
    std::optional<base::Time> last;  ///< that was used, by the robot's clock
    std::optional<base::Time> gap;   ///< when there last was none for long
    std::uint64_t used = 0;

    void note(base::Time now);
    /// Its inputs came regularly of late.
    [[nodiscard]] bool regular(base::Time now) const;
  };
  /// The observations of one run of the robot.
  struct Seen {
    explicit Seen(base::Time now) : begun(now), looked(now), camera_worked(now), wheels_worked(now) {}

    base::Time begun;
    base::Time looked;
    std::optional<base::Time> kept_away;  ///< until then the loop did not turn
    StopOracle oracle;
    std::uint32_t frames = 0;
    std::optional<base::Time> stream;
    Input camera;
    Input odometry;
    std::optional<sensor::OdometrySample> last_sample;
    std::optional<sensor::BlobFrame> last_frame;
    base::Time same_since;                            ///< boxes are as they are
    bool late = false;                                ///< although they should have moved
    int slow_images = 0;                              ///< such ones, one after the other
    base::Duration slow_image;                        ///< the time of the last one, and a fifth more
    std::optional<sensor::OdometrySample> same_from;  ///< where the robot was then, or when odometry was well again
    std::deque<sensor::OdometrySample> samples;       ///< lately
    std::optional<base::Time> frozen;                 ///< since when they should have moved by far
    std::optional<base::Time> strange;                ///< the last input that may be disbelieved, or was refused
    std::optional<base::Time> urgent;                 ///< since when stop or blind is in force
    base::Time camera_worked;                         ///< by its link's last good state
    base::Time wheels_worked;
    console::Counters counters;
  };
  void note_inputs(const StormRobot& robot, const Outside& outside, base::Time now);
  /// `in_time`: it did not lie anywhere on its way, so it was seen from where the robot was when it came.
  void note_frame(const sensor::BlobFrame& frame, const sensor::CameraIntrinsics& camera, bool in_time, base::Time now);
  /// The loop was not kept away lately.
  [[nodiscard]] bool caught_up(base::Time now) const;
  void forget_image(base::Time now);
  void note_change(base::Time t);
  void note_motion(const sensor::BlobFrame& frame, const sensor::CameraIntrinsics& camera, base::Time now);
  [[nodiscard]] std::optional<sensor::OdometrySample> sample_at(base::Time t) const;
  void note_sample(const sensor::OdometrySample& sample, base::Time now);
  void check_blind(const StormRobot& robot, const Outside& outside, base::Time now);
  void check_frozen(const StormRobot& robot, base::Time now);
  void check_stop(const StormRobot& robot, base::Time now);
  void check_output(const StormRobot& robot, const Outside& outside, base::Time now);
  void check_links(const StormRobot& robot, const Outside& outside, base::Time now);
  void fault(const char* check, base::Time now, const std::string& sentence);

  static constexpr std::size_t kMax = 20;

  std::vector<Fault>& faults_;
  Seen seen_{base::Time{}};
};

}  // namespace fencepost::test
