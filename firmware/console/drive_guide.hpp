// Guides the drive that `fencepost calibrate` needs (host/share/doc/calibrate.md): counts what was driven and seen in a
// log, and says what is missing. What is enough was judged by the sigmas of simulated drives
// (tests/studies/calibrate/drive_guide_test.cpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/recon/observe/frame_queue.hpp"
#include "firmware/recon/observe/pose_history.hpp"

namespace fencepost::console {

/// The needs of a drive, in the order in which they are said.
enum class DriveNeed : std::uint8_t {
  kBlocks,     ///< that the map knows
  kStraights,  ///< with a near and a far block in view: yaw
  kAround,     ///< focal length, track
  kLeft,       ///< latency
  kRight,
  kLeftSide,  ///< of the image: lens
  kRightSide,
  kFeet,  ///< pitch, height
};
inline constexpr std::size_t kDriveNeeds = 8;

class DriveGuide {
 public:
  /// Counts from now on.
  void begin() {
    *this = {};
    on_ = true;
  }
  /// A new run: a log before it is no longer the log.
  void new_run() {
    if (on_) begin();
  }
  [[nodiscard]] bool on() const { return on_; }
  [[nodiscard]] bool lacks(DriveNeed need) const { return ((met_ >> static_cast<unsigned>(need)) & 1U) == 0; }
  [[nodiscard]] bool enough() const { return met_ == kAllMet; }

  /// Counts a frame of the log, at that pose of the odometry; `known`: confirmed objects of the map. True if a need is
  /// met that was not said yet.
  bool look(const recon::WaitingFrame& frame, const recon::CameraModel& camera, const recon::MapPose& pose,
            unsigned known);
  /// Marks all needs met so far as said. After the last need the guide ends; the next `calibrate` begins anew.
  void say() {
    said_ = met_;
    on_ = !enough();
  }

  /// One line about the drive, `line` below lines(): a heading, then one a need that is not met; or that it is enough.
  [[nodiscard]] std::size_t write(std::size_t line, bool logs, std::span<char> out) const;
  [[nodiscard]] std::size_t lines(bool logs) const;

 private:
  static constexpr std::uint8_t kAllMet = (1U << kDriveNeeds) - 1;

  void count_blobs(const recon::WaitingFrame& frame, const recon::CameraModel& camera);
  void count_step(float way, std::int32_t turn, bool in_view);
  [[nodiscard]] bool met(DriveNeed need) const;

  recon::MapPose last_;      ///< where the last step ended
  std::int32_t turned_ = 0;  ///< urad since the beginning, until it was around; and its extremes
  std::int32_t most_ = 0;
  std::int32_t least_ = 0;
  std::int32_t left_ = 0;   ///< urad, sum of turns to the left
  std::int32_t right_ = 0;  ///< positive
  std::int32_t off_ = 0;    ///< urad from where the straight began
  float straight_ = 0;      ///< m, with a block in view
  std::uint8_t straights_ = 0;
  std::uint8_t known_ = 0;
  std::uint8_t left_side_ = 0;  ///< frames
  std::uint8_t right_side_ = 0;
  std::uint8_t feet_ = 0;
  std::uint8_t met_ = 0;  ///< bits by DriveNeed
  std::uint8_t said_ = 0;
  bool on_ = false;
  bool apart_ = false;  ///< on this straight a near and a far block were in view
  bool placed_ = false;
};

// A micro:bit has few to spare.
static_assert(sizeof(DriveGuide) <= 52);

}  // namespace fencepost::console
