// The protocol state machine of an NXTCam v5 on the serial line between its camera and its bridge. Independent of the
// link.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "drivers/nxtcam/serial.hpp"
#include "drivers/serial/outbox.hpp"
#include "drivers/wire/scanner.hpp"
#include "hal/base/fixed.hpp"
#include "hal/base/units.hpp"
#include "hal/sensor/blob_frame.hpp"
#include "hal/sensor/link_state.hpp"

namespace fencepost::nxtcam {

/// Our sources describe only the frames that the v5 sends, not which it accepts or what it sends while it sees nothing.
/// Cameras may differ in these points.
struct V5Options {
  /// Nothing marks a frame's last blob: it is complete with the first blob of another count, or once no byte came
  /// for so long.
  base::Duration frame_pause = base::milliseconds(8);
  /// Asks for the version (type 1, without data) once a second. While no blob comes it asks more often and also
  /// commands 'E', tracking on (type 3). Uncertain whether the camera accepts either. One that accepts neither is heard
  /// by its blobs alone, and never `empty`.
  bool ask = true;
  /// Whether silence of a camera that was heard once means that it sees nothing. False: after `timeout` it is silent.
  /// True where it is known to be mute without blobs and not to answer; an unplugged one then seems to see nothing.
  bool silence_is_empty = false;
  base::Duration timeout = base::milliseconds(2'500);  ///< without a whole frame of any type
  /// Without a blob for so long, but with an answer to a question: a frame without blobs.
  base::Duration empty_period = base::milliseconds(100);
  base::Duration start_up = base::milliseconds(500);  ///< after it was first heard, before a frame without blobs
};

struct V5Counts {
  std::uint32_t frames = 0;
  std::uint32_t blobs_dropped = 0;  ///< of more than sixteen, the smallest
  std::uint32_t late = 0;           ///< blobs of a frame already given: the line had stopped within it
  std::uint32_t stale = 0;          ///< frames dropped because they arrived bunched with an earlier one
  std::uint32_t unrelated = 0;      ///< whole frames that are neither blob nor version
  std::uint32_t rejected = 0;       ///< impossible blobs in spite of the checksum
};

/// Source: the v5 section of our protocol notes (mindsensors NXTCamView5). Frames carry a checksum of one byte: one
/// damaged frame in 256 passes.
class V5Session {
 public:
  explicit V5Session(const V5Options& options) : options_(options) {}

  void take(std::uint8_t byte, base::Time now);
  void step(base::Time now);
  void lose_link();
  void find_link() { absent_ = false; }
  /// The frame that the last bytes brought, once, where it lies until the next one; nullptr: none.
  const sensor::BlobFrame* take_frame() { return std::exchange(fresh_, false) ? &complete_ : nullptr; }

  auto& outbox() { return outbox_; }
  /// kUnready: heard, and for `start_up` no blob has come.
  [[nodiscard]] sensor::LinkState link() const;
  [[nodiscard]] const V5Counts& counts() const { return counts_; }
  [[nodiscard]] std::uint32_t damaged() const { return scanner_.damaged(); }
  /// Data of the last frame of type 1, as far as it is printable; its layout is described nowhere.
  [[nodiscard]] std::string_view version() const { return version_.view(); }

 private:
  void take_message(std::span<const std::uint8_t> message, base::Time first_byte, base::Time now);
  void take_blob(const V5Blob& blob, base::Time first_byte, base::Time now);
  void take_version(std::span<const std::uint8_t> message);
  void finish(base::Time now);
  void ask(base::Time now);
  void give_empty(base::Time now);
  void forget_bytes();

  V5Options options_;
  wire::Scanner<kLongestV5, examine_v5> scanner_;
  serial::Outbox<16> outbox_;
  bool absent_ = false;
  std::optional<base::Time> found_;  ///< when it was first heard after silence
  base::Time heard_;
  base::Time blob_at_;  ///< the last blob, or the last frame without
  base::Time asked_;
  base::Time byte_at_;
  std::uint32_t unexplained_ = 0;          ///< bytes that are, so far, of no whole frame
  std::optional<base::Time> quiet_since_;  ///< whole frames come since, and no blobs
  bool asked_once_ = false;
  bool building_ = false;
  std::uint8_t number_ = 0;  ///< the camera's count, of the frame being built or last given
  bool seen_ = false;        ///< the last frame had blobs
  bool given_ = false;
  std::optional<base::Time> last_t_;
  sensor::BlobFrame frame_;
  sensor::BlobFrame complete_;
  bool fresh_ = false;  ///< complete_ was not taken yet
  base::FixedString<32> version_;
  V5Counts counts_;
};

}  // namespace fencepost::nxtcam
