// The protocol state machine of an NXTCam on I2C: the next transfer, and what its result means. Independent of the bus.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "drivers/nxtcam/registers.hpp"
#include "hal/base/fixed.hpp"
#include "hal/base/result.hpp"
#include "hal/base/units.hpp"
#include "hal/sensor/blob_frame.hpp"
#include "hal/sensor/link_state.hpp"

namespace fencepost::nxtcam {

struct Options {
  /// After each command of the start-up. The guide gives none; programs of others wait 100 to 500 ms.
  base::Duration command_wait = base::milliseconds(200);
  /// The same where it need only go on: the least that these wait.
  base::Duration again_wait = base::milliseconds(100);
  base::Duration period = base::milliseconds(33);  ///< 30 frames a second
  bool check_colour_map = true;                    ///< false where the registers of the map are not as in the v4
  bool lock_buffer = false;                        ///< later v4 only: nothing is torn between the reads of one frame
};

struct Counters {
  std::uint32_t frames = 0;
  std::uint32_t blobs_dropped = 0;  ///< always 0: eight objects fit
  std::uint32_t refused = 0;        ///< transfers not acknowledged or failed
  std::uint32_t rejected = 0;       ///< frames with an impossible count or object
  std::uint32_t restarts = 0;
};

/// Write `out`, then read `expected` bytes.
struct Transfer {
  base::FixedVector<std::uint8_t, 2> out;
  std::size_t expected = 0;
  friend constexpr bool operator==(const Transfer&, const Transfer&) = default;
};

/// Identity, tracking off, colour map, sort by size, objects, tracking on; then count and objects indefinitely, at most
/// sixteen bytes a transfer. A camera that showed objects before a silence is not stopped or asked for its colours on
/// the first new try. Either it still tracks, or it was switched off and on and waits for the rest alone. While nothing
/// is seen, tracking is switched on again now and then. The reason: a camera that was switched off and on between two
/// reads answers as if it saw nothing.
class Session {
 public:
  explicit Session(const Options& options) : options_(options) {}

  /// The next transfer if its time has come; it then counts as begun.
  std::optional<Transfer> due(base::Time now);
  /// The answer to it: as many bytes as expected, and when they began to arrive. Fewer are a failure.
  void take(std::span<const std::uint8_t> bytes, base::Time t);
  /// It failed. kGone: there is no bus; anything else: nobody answered.
  void fail(base::Error error, base::Time now);

  /// The frame that the last `take` completed, once, where it lies until the next one; nullptr: none.
  const sensor::BlobFrame* take_frame() { return std::exchange(fresh_, false) ? &building_ : nullptr; }

  [[nodiscard]] sensor::LinkState link() const { return link_; }
  [[nodiscard]] const Counters& counters() const { return counters_; }
  /// As the camera says, such as "V1.20"; empty before.
  [[nodiscard]] const base::FixedString<8>& version() const { return version_; }

 private:
  enum class Step : std::uint8_t {
    kVersion,
    kProduct,
    kDisable,
    kFetchMap,
    kMap1,
    kMap2,
    kMap3,
    kSort,
    kObjects,
    kEnable,
    kLock,
    kCount,
    kMore,
    kRest,
    kUnlock
  };

  [[nodiscard]] Transfer transfer() const;
  void advance(Step step, base::Duration pause, base::Time t);
  void restart(base::Duration pause, base::Time t);
  void take_enabled(base::Time t);
  void take_version(std::span<const std::uint8_t> bytes);
  void take_map(std::span<const std::uint8_t> bytes, base::Time t);
  void take_count(std::span<const std::uint8_t> bytes, base::Time t);
  void take_objects(std::span<const std::uint8_t> bytes, base::Time t);
  void finish_frame(base::Time t);
  void next_frame(base::Time t);
  void reject(base::Time t);

  Options options_;
  Step step_ = Step::kVersion;
  sensor::LinkState link_ = sensor::LinkState::kSilent;
  std::uint8_t failures_ = 0;
  base::Duration wait_;  ///< after each command of this start
  bool proven_ = false;  ///< it has shown objects since it was last asked for its colours
  std::optional<base::Time> next_;
  base::Time started_;
  base::Time last_seen_;
  std::uint8_t expected_ = 0;  ///< objects of the frame that is being read
  std::array<std::uint8_t, kColourMapSize> map_{};
  sensor::BlobFrame building_;
  bool fresh_ = false;  ///< building_ was not taken yet
  base::FixedString<8> version_;
  Counters counters_;
};

}  // namespace fencepost::nxtcam
