// The capacities of the loop for each size of part, with their reasons. The resulting bytes are checked against the
// budget where the memory is defined (firmware/loop/memory.hpp).
#pragma once

#include <cstddef>
#include <string_view>

#include "firmware/recon/models/hybrid/hybrid.hpp"
#include "firmware/recon/models/model_list.hpp"
#include "hal/base/units.hpp"

namespace fencepost::config {

/// 16 KB of RAM (micro:bit v1): the loop gets 10 KB, the rest is stack and start-up.
struct Micro {
  static constexpr std::string_view kName = "micro";
  static constexpr std::size_t kObjects = 4;
  static constexpr std::size_t kModelTurns = 1;  ///< objects a frame whose models take their sighting: most of the work
  static constexpr std::size_t kLookTurns = 1;   ///< landmarks that are compared with odometry while it is believed
  static constexpr base::Duration kModelInterval = base::milliseconds(30);  ///< between two such frames, at least
  static constexpr std::size_t kSignatures = 4;
  static constexpr std::size_t kFronts = 64;         ///< points of the guard, 8 bytes each
  static constexpr bool kSeesFloor = false;          ///< which floor was seen empty, 1 KB: no `sectors` without it
  static constexpr std::size_t kTracks = 4;          ///< things that may move by themselves, 32 bytes each
  static constexpr std::size_t kPoses = 24;          ///< 0.5 s of 50 Hz odometry: latency plus the 0.2 s of waiting
  static constexpr std::size_t kOutputBytes = 1024;  ///< one longest line
  static constexpr std::size_t kJournalBytes = 0;    ///< of a log beside the console: a brain with a disk has one
  static constexpr std::size_t kBudget = 10 * 1024 + 24;  ///< bytes of Memory, reserves included
  static constexpr std::size_t kHybridSectors = 32;       ///< of directions: the small version, a series of order 5
  static constexpr std::size_t kHybridOrder = 5;
  static constexpr int kHybridSteps = 1;  ///< of a fit in a frame
  static constexpr bool kPredictsByOutline =
      false;                                       ///< but by the cylinder: 1.3 KB of code and 5,000 steps a frame less
  static constexpr std::size_t kPoseBytes = 1024;  ///< of the pose correction, at most: each object may be a landmark
  using Models = recon::ModelList<recon::Cylinder, recon::Hybrid<kHybridSectors>>;
  using ComparisonModels = recon::NoModels;
  using OutlineBatch = recon::NoBatch;
};

/// 64 KB (a Pico or STM32F405 has more: room for drivers and the student's own code).
struct Small {
  static constexpr std::string_view kName = "small";
  static constexpr std::size_t kObjects = 8;
  static constexpr std::size_t kModelTurns = 2;
  static constexpr std::size_t kLookTurns = 1;
  static constexpr base::Duration kModelInterval = base::milliseconds(30);
  static constexpr std::size_t kSignatures = 8;
  static constexpr std::size_t kFronts = 64;
  static constexpr bool kSeesFloor = true;
  static constexpr std::size_t kTracks = 8;
  static constexpr std::size_t kPoses = 64;
  static constexpr std::size_t kOutputBytes = 4096;
  static constexpr std::size_t kJournalBytes = 0;
  static constexpr std::size_t kBudget = 64 * 1024;
  static constexpr std::size_t kHybridSectors = 64;
  static constexpr std::size_t kHybridOrder = 3;
  static constexpr int kHybridSteps = 8;
  static constexpr bool kPredictsByOutline = true;
  static constexpr std::size_t kPoseBytes = 1664;
  using Models = recon::ModelList<recon::Cylinder, recon::Hybrid<kHybridSectors>>;
  using ComparisonModels = recon::NoModels;
  using OutlineBatch = recon::NoBatch;
};

/// The desk and Linux brains.
struct Full {
  static constexpr std::string_view kName = "full";
  static constexpr std::size_t kObjects = 64;           ///< 45 s along parked cars fill 32
  static constexpr std::size_t kModelTurns = kObjects;  ///< all that are seen
  static constexpr std::size_t kLookTurns = kObjects;
  static constexpr base::Duration kModelInterval{0};
  static constexpr std::size_t kSignatures = 32;
  static constexpr std::size_t kFronts = 64;
  static constexpr bool kSeesFloor = true;
  static constexpr std::size_t kTracks = 8;
  static constexpr std::size_t kPoses = 256;
  static constexpr std::size_t kOutputBytes = 16384;
  static constexpr std::size_t kJournalBytes = 0;
  static constexpr std::size_t kBudget = 192 * 1024;
  static constexpr std::size_t kHybridSectors = 64;
  static constexpr std::size_t kHybridOrder = 3;
  static constexpr int kHybridSteps = 0;  ///< all of them
  static constexpr bool kPredictsByOutline = true;
  static constexpr std::size_t kPoseBytes = 69'760;  ///< 64 landmarks; 8 need 1.6 KB
  using Models = recon::ModelList<recon::Cylinder, recon::Hybrid<kHybridSectors>>;
  using ComparisonModels = recon::NoModels;
  using OutlineBatch = recon::NoBatch;
};

}  // namespace fencepost::config
