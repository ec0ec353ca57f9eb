// HuskyLens 1 and 2: UART and I2C carry the same frames. Which one it is, the knock that it answers says.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "drivers/huskylens/frames.hpp"
#include "drivers/serial/outbox.hpp"
#include "drivers/wire/flush.hpp"
#include "drivers/wire/receive.hpp"
#include "drivers/wire/scanner.hpp"
#include "hal/base/units.hpp"
#include "hal/bus/byte_link.hpp"
#include "hal/sensor/blob_frame.hpp"
#include "hal/sensor/camera.hpp"
#include "hal/sensor/link_state.hpp"
#include "hal/sensor/sources.hpp"

namespace fencepost::huskylens {

inline constexpr std::uint8_t kAddress = 0x32;   ///< on I2C, seven bits
inline constexpr std::uint8_t kAddress2 = 0x50;  ///< of HuskyLens 2

/// The vendor does not say what lens it has: 60 degrees across are assumed, fx = 160 / tan 30 deg. Calibrate. The
/// latency: one image of 30 /s, and a question and its answer at 9600 baud.
inline constexpr sensor::CameraIntrinsics kProfile = {"huskylens", kWidth,   kHeight, {27'713}, {27'713},
                                                      {15'950},    {11'950}, {0},     {},       base::milliseconds(80)};

/// HuskyLens 2, as little known: twice the columns, and at 115200 baud a question is short.
inline constexpr sensor::CameraIntrinsics kProfile2 = {
    "huskylens2", kWidth2, kHeight2, {55'426}, {55'426}, {31'950}, {23'950}, {0}, {}, base::milliseconds(60)};

struct Options {
  Generation generation = Generation::kOne;  ///< tried first; boxes refer to its image
  bool select_colour = true;                 ///< false leaves the algorithm that runs alone
  /// Without a byte for so long the answer is lost.
  base::Duration timeout = base::milliseconds(100);
  /// The image counter may stand still for so long.
  base::Duration frozen = base::milliseconds(2'000);
};

struct Counts {
  std::uint32_t frames = 0;
  std::uint32_t blobs_dropped = 0;  ///< beyond sixteen, the smallest
  std::uint32_t not_learned = 0;    ///< blocks without an id
  std::uint32_t stale = 0;          ///< answers about an image that was given already
  std::uint32_t timeouts = 0;
  std::uint32_t busy = 0;
  std::uint32_t broken = 0;    ///< answers given up because of damage
  std::uint32_t restarts = 0;  ///< conversations begun anew
};

/// One question is outstanding at a time. After five lost answers in a row, or twenty refusals, the conversation begins
/// anew. After five lost knocks the other generation is tried, or after thirty if one has answered before. A HuskyLens
/// 2 takes the other's knocks for data, and then does not hear some of its own.
class Session {
 public:
  explicit Session(const Options& options) : options_(options), generation_(options.generation) {}

  void take(std::uint8_t byte, base::Time now);
  /// Lets time pass; the next question, if it is due, is then in the outbox.
  void step(base::Time now);
  void lose_link();
  void find_link() { absent_ = false; }

  /// The frame that the last bytes brought, once, where it lies until the next one; nullptr: none.
  const sensor::BlobFrame* take_frame() { return std::exchange(fresh_, false) ? &complete_ : nullptr; }
  auto& outbox() { return outbox_; }
  [[nodiscard]] sensor::LinkState link() const;
  /// That answered last, or is tried.
  [[nodiscard]] Generation generation() const { return generation_; }
  [[nodiscard]] const Counts& counts() const { return counts_; }
  /// Frames with a wrong checksum.
  [[nodiscard]] std::uint32_t damaged() const { return scanner_.damaged(); }

 private:
  enum class Step : std::uint8_t { kKnock, kAlgorithm, kBlocks };

  void take_message(const Message& message, base::Time first_byte, base::Time now);
  void take_done(base::Time now);
  void take_info(const Info& info, base::Time first_byte, base::Time now);
  void take_block(const Message& block);
  void finish_if_whole(base::Time now);
  void answered(base::Time now, base::Duration pause);
  [[nodiscard]] base::Duration patience() const;
  void put_question();
  void expire(base::Time now);
  void restart();
  void begin_again();
  void choose_generation();

  Options options_;
  wire::Scanner<kLongestFrame, examine> scanner_;
  serial::Outbox<16> outbox_;
  Generation generation_;
  std::optional<Generation> known_;  ///< that answered last
  std::uint8_t rounds_ = 0;          ///< of knocks that it has not answered since
  Step step_ = Step::kKnock;
  sensor::LinkState work_ = sensor::LinkState::kUnready;  ///< while it answers
  bool absent_ = false;
  bool heard_ = false;
  bool waiting_ = false;
  std::uint8_t missed_ = 0;
  std::uint8_t refused_ = 0;  ///< questions, one after the other
  base::Time deadline_;
  base::Time next_;  ///< of the next question
  bool building_ = false;
  std::uint16_t left_ = 0;  ///< objects still to come
  bool taught_ = false;
  std::optional<std::uint16_t> number_;  ///< of the last image that was given
  std::optional<std::uint16_t> building_number_;
  base::Time new_image_;
  std::optional<base::Time> last_t_;
  sensor::BlobFrame frame_;
  sensor::BlobFrame complete_;
  bool fresh_ = false;  ///< complete_ was not taken yet
  Counts counts_;
};

template <bus::ByteLink Link>
class Camera {
 public:
  explicit Camera(Link& link, const Options& options = {}) : link_(link), session_(options) {}

  base::Result<sensor::BlobFrame> poll(base::Time now) {
    const bool found = wire::receive(link_, kReads, [&](std::span<const std::uint8_t> bytes) {
      for (const std::uint8_t byte : bytes) session_.take(byte, now);
    });
    found ? session_.find_link() : session_.lose_link();
    session_.step(now);
    if (!wire::flush(session_.outbox(), link_)) session_.lose_link();
    if (const sensor::BlobFrame* frame = session_.take_frame()) return *frame;
    return base::Error::kNotReady;
  }
  [[nodiscard]] sensor::LinkState link() const { return session_.link(); }
  [[nodiscard]] std::uint32_t dropped() const { return session_.counts().blobs_dropped; }
  [[nodiscard]] const Session& session() const { return session_; }

 private:
  static constexpr int kReads = 8;  ///< 256 bytes: more than a loop may sleep at 9600 baud

  Link& link_;
  Session session_;
};

}  // namespace fencepost::huskylens
