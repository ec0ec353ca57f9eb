// A long drive with everything that happens to a robot in it, and the rules that hold all the time.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace fencepost::test {

/// A lap in an empty map, compared with its three blocks.
struct LapQuality {
  unsigned found = 0;       ///< of three: confirmed and where they are
  double center_error = 0;  ///< m, of the cylinders, mean
  double recklessness = 0;  ///< of the cylinders, mean
  double paranoia = 0;
};

struct SoakFigures {
  double minutes = 0;  ///< of the robot's clock
  std::uint64_t frames_offered = 0;
  std::uint64_t frames_used = 0;
  std::uint64_t frames_refused = 0;
  std::uint64_t commands = 0;
  unsigned runs_replayed = 0;          ///< each between two resets, in mode log throughout
  std::uint64_t digests_compared = 0;  ///< within those
  bool frame_counter_wrapped = false;
  bool clock_word_wrapped = false;  ///< the low 32 bits of the stream's time
  LapQuality at_start;
  LapQuality far_away;  ///< 100 m from the origin
  LapQuality at_end;
  unsigned present = 0;             ///< blocks of the last of three laps without a reset, blocks changing every lap
  unsigned present_found = 0;       ///< of those, in the map
  std::vector<std::string> faults;  ///< has to be empty
};

/// `rounds` of about 40 s, a third of them 100 m away. The same seed drives the same way.
/// errors: throws std::runtime_error with a sentence; std::invalid_argument for an unknown profile
SoakFigures run_soak(std::string_view profile, unsigned rounds, unsigned seed);

}  // namespace fencepost::test
