// The protocol state machine of a Pixy2: the next request, what replies mean, the link's state. Independent of the bus.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "drivers/pixy2/protocol.hpp"
#include "hal/base/units.hpp"
#include "hal/sensor/blob_frame.hpp"
#include "hal/sensor/link_state.hpp"

namespace fencepost::pixy2 {

struct Options {
  std::uint8_t signatures = 0x7F;  ///< requested; bit 7 adds colour codes. 0: always unready
  bool select_program = true;      ///< false keeps the running program and a button's choice
};

struct Counters {
  std::uint32_t frames = 0;
  std::uint32_t blobs_dropped = 0;
  std::uint32_t timeouts = 0;   ///< missing replies
  std::uint32_t malformed = 0;  ///< whole packets with impossible content, or not requested
  std::uint32_t restarts = 0;   ///< of the start sequence
};

/// One request is outstanding at a time. Version (a starting camera replies busy), program, resolution, then blocks
/// indefinitely. After three missing replies, or a reply of another program, the sequence restarts.
class Session {
 public:
  explicit Session(const Options& options) : options_(options) {}

  /// The next request if its time has come; it then counts as sent.
  std::optional<Request> due(base::Time now);

  /// `first_byte`: when the packet's first byte arrived.
  void take(const Packet& packet, base::Time first_byte, base::Time now);
  /// A packet has begun to arrive: the reply is late, not lost.
  void extend(base::Time now);
  /// A damaged packet arrived: most likely the reply, so waiting on is pointless.
  void take_damage(base::Time now);
  /// The link is unplugged, or takes or gives bytes (again).
  void lose_link(base::Time now);
  void find_link() { absent_ = false; }

  /// The frame that the last `take` brought, once, where it lies until the next one; nullptr: none.
  const sensor::BlobFrame* take_frame() { return std::exchange(fresh_, false) ? &frame_ : nullptr; }

  [[nodiscard]] sensor::LinkState link() const;
  [[nodiscard]] bool waiting() const { return waiting_; }
  [[nodiscard]] const std::optional<Version>& version() const { return version_; }
  [[nodiscard]] const Counters& counters() const { return counters_; }

 private:
  enum class Step : std::uint8_t { kVersion, kProgram, kResolution, kBlocks };

  [[nodiscard]] Request request() const;
  void expire(base::Time now);
  void restart();
  void ask_after(base::Duration pause, base::Time now);
  bool take_answer(const Packet& packet, base::Time first_byte, base::Time now);
  bool take_version(const Packet& packet);
  bool take_result(const Packet& packet);
  bool take_resolution(const Packet& packet);
  bool take_blocks(const Packet& packet, base::Time first_byte);
  void take_error(DeviceError error, base::Time now);

  Options options_;
  Step step_ = Step::kVersion;
  sensor::LinkState work_ = sensor::LinkState::kUnready;  ///< while it answers
  bool absent_ = false;
  bool heard_ = false;
  bool waiting_ = false;
  std::uint8_t missed_ = 0;
  base::Time asked_;
  base::Time deadline_;
  std::optional<base::Time> next_;  ///< of the next request; empty: at once
  base::Time last_frame_;
  base::Duration pause_;
  sensor::BlobFrame frame_;
  bool fresh_ = false;  ///< frame_ was not taken yet
  std::optional<Version> version_;
  Counters counters_;
};

}  // namespace fencepost::pixy2
