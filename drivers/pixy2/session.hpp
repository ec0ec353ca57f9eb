// The conversation with a Pixy2: what to ask next, what the answers mean, how the link is. Knows no bus.
#pragma once

#include <cstdint>
#include <optional>

#include "drivers/pixy2/protocol.hpp"
#include "hal/base/units.hpp"
#include "hal/sensor/blob_frame.hpp"
#include "hal/sensor/link_state.hpp"

namespace fencepost::pixy2 {

struct Options {
  std::uint8_t signatures = 0x7F;  ///< that are asked for; bit 7 adds colour codes. 0: unready for ever
  bool select_program = true;      ///< false leaves the program that runs, and a button's choice, alone
};

struct Counters {
  std::uint32_t frames = 0;
  std::uint32_t blobs_dropped = 0;
  std::uint32_t timeouts = 0;   ///< answers that did not come
  std::uint32_t malformed = 0;  ///< whole packets with impossible content, or that nobody asked for
  std::uint32_t restarts = 0;   ///< conversations begun anew
};

/// One request is outstanding at a time. Version (a starting camera says busy), program, resolution, then blocks for
/// ever. Three answers missing, or an answer that another program gives: all over again.
class Session {
 public:
  explicit Session(const Options& options) : options_(options) {}

  /// The next request if its time has come; it then counts as sent.
  std::optional<Request> due(base::Time now);

  /// `first_byte`: when the packet's first byte arrived.
  void take(const Packet& packet, base::Time first_byte, base::Time now);
  /// A packet has begun to arrive: the answer is late, not lost.
  void extend(base::Time now);
  /// A damaged packet came: it was the answer, most likely; there is no point in waiting on.
  void take_damage(base::Time now);
  /// The link is unplugged, or takes or gives bytes (again).
  void lose_link(base::Time now);
  void find_link() { absent_ = false; }

  /// The frame that the last `take` brought, once.
  std::optional<sensor::BlobFrame> take_frame();

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
  std::optional<sensor::BlobFrame> frame_;
  std::optional<Version> version_;
  Counters counters_;
};

}  // namespace fencepost::pixy2
