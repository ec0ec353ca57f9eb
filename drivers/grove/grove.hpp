// Seeed's Grove Vision AI V2: its SSCMA firmware answers AT commands with JSON, on a serial line and on I2C.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "drivers/serial/hearing.hpp"
#include "drivers/serial/outbox.hpp"
#include "drivers/serial/pump.hpp"
#include "hal/base/fixed.hpp"
#include "hal/base/units.hpp"
#include "hal/bus/i2c_bus.hpp"
#include "hal/sensor/blob_frame.hpp"
#include "hal/sensor/camera.hpp"
#include "hal/sensor/link_state.hpp"
#include "hal/sensor/sources.hpp"

namespace fencepost::grove {

inline constexpr std::uint8_t kAddress = 0x62;  ///< on I2C, seven bits

/// Boxes become pixels of such a picture, whatever resolution a message names.
inline constexpr std::uint16_t kSide = 240;

/// The usual lens, an OV5647 of 62 degrees: fx = 120 / tan 31 deg. Which part of its picture the firmware keeps is not
/// known: calibrate. The latency is a guess: a picture, and a model that takes 60 ms.
inline constexpr sensor::CameraIntrinsics kProfile = {"grove",  kSide,    kSide, {19'971}, {19'971},
                                                      {11'950}, {11'950}, {0},   {},       base::milliseconds(100)};

enum class Event : std::uint8_t {
  kNone,
  kMessage,  ///< whole, but no boxes
  kStarted,  ///< the reply to the command that starts it
  kFrame,    ///< frame() is new
};

struct Counts {
  std::uint32_t damaged = 0;     ///< messages that are cut, or no JSON
  std::uint32_t impossible = 0;  ///< frames with impossible boxes
  std::uint32_t unused = 0;      ///< results without boxes: classes, points, an error
  std::uint32_t dropped = 0;     ///< blobs of good frames beyond the capacity
};

/// A message is CR, an object of JSON on one line, and LF or CR LF. It is read byte by byte and never kept: of its
/// values only those are stored that boxes are made of. x and y of a box are its middle; its target is the model's
/// class, from 0: signature 1. No message has a checksum: a frame counts only if all of it is JSON.
class Decoder {
 public:
  /// One byte that arrived at `now`.
  Event feed(std::uint8_t byte, base::Time now);
  /// Forgets a message that has begun.
  void reset() { state_ = State::kOutside; }

  [[nodiscard]] const sensor::BlobFrame& frame() const { return frame_; }
  [[nodiscard]] const Counts& counts() const { return counts_; }

 private:
  enum class State : std::uint8_t {
    kOutside,
    kBegin,  ///< behind CR
    kFirstKey,
    kKey,
    kColon,
    kFirstValue,
    kValue,
    kText,
    kEscape,
    kSign,
    kNumber,
    kFraction,
    kWord,
    kAfter,  ///< behind a value
    kEnd,    ///< behind the message's last brace
  };
  enum class Key : std::uint8_t { kOther, kType, kName, kCode, kData, kCount, kBoxes, kResolution };
  struct Box {
    std::int16_t x = 0;
    std::int16_t y = 0;
    std::int16_t width = 0;
    std::int16_t height = 0;
    std::uint8_t signature = 0;
  };

  static constexpr std::uint8_t kMaxDepth = 6;  ///< of results with points
  static constexpr std::size_t kMaxText = 10;   ///< `resolution`
  static constexpr std::size_t kBoxNumbers = 6;

  Event end_line(bool carriage_return);
  void advance(char c, base::Time now);
  void begin(base::Time now);
  void begin_value(char c);
  void begin_number(char c);
  void continue_number(char c);
  void after_value(char c);
  void open(bool array);
  void close(bool array);
  void end_text();
  void end_number();
  void end_box();
  Event finish();
  [[nodiscard]] bool shows(const Box& box) const;  ///< a part of it is in the picture
  [[nodiscard]] sensor::Blob blob_of(const Box& box) const;
  void damage();
  [[nodiscard]] bool in_array() const { return (arrays_ >> depth_ & 1U) != 0; }
  [[nodiscard]] bool in(Key key) const { return depth_ > 2 && keys_[1] == Key::kData && keys_[2] == key; }

  State state_ = State::kOutside;
  std::uint8_t depth_ = 0;
  std::uint8_t arrays_ = 0;    ///< bit n: what is open at depth n is an array
  std::array<Key, 3> keys_{};  ///< by depth, from 1
  bool in_key_ = false;
  std::array<char, kMaxText> text_{};
  std::uint8_t text_size_ = 0;  ///< one more than kMaxText: too long
  bool negative_ = false;
  std::int32_t value_ = 0;
  std::uint8_t digits_ = 0;
  std::array<std::int32_t, kBoxNumbers> numbers_{};
  std::uint8_t number_count_ = 0;

  base::Time begun_;
  std::optional<std::int32_t> type_;
  std::optional<std::int32_t> code_;
  std::optional<std::int32_t> count_;
  bool invoke_ = false;
  bool has_boxes_ = false;
  bool impossible_ = false;
  std::uint32_t over_ = 0;
  std::array<std::int32_t, 2> resolution_{};
  base::FixedVector<Box, sensor::kMaxBlobs> boxes_;
  sensor::BlobFrame frame_;
  Counts counts_;
};

/// Starts it, and again while no frame comes: after a power cycle it waits for commands.
class Session {
 public:
  using Sample = sensor::BlobFrame;

  bool take(std::uint8_t byte, base::Time now);
  [[nodiscard]] const sensor::BlobFrame& sample() const { return decoder_.frame(); }
  void step(base::Time now);
  void link_lost();
  auto& outbox() { return outbox_; }

  /// kUnready: it answers, and no frame comes: it has no model, or one that finds no boxes.
  [[nodiscard]] sensor::LinkState link() const { return hearing_.link(decoder_.frame()); }
  [[nodiscard]] std::uint32_t dropped() const { return decoder_.counts().dropped; }
  [[nodiscard]] const Counts& counts() const { return decoder_.counts(); }

 private:
  Decoder decoder_;
  serial::Outbox<32> outbox_;
  bool begun_ = false;
  serial::Hearing hearing_;
  base::Time next_start_;
};

/// 921600 Bd 8N1. A frame's t is when the first byte of its message arrived.
template <bus::ByteLink Link>
using Camera = serial::Pump<Link, Session>;

/// On I2C. Its bytes are read in packets, each requested by one of its own; between two transfers it needs a rest.
template <bus::I2cBus Bus>
class I2cCamera {
 public:
  explicit I2cCamera(Bus& bus, std::uint8_t address = kAddress) : bus_(bus), address_(address) {}

  base::Result<sensor::BlobFrame> poll(base::Time now) {
    session_.step(now);
    bool complete = false;
    if (busy_) complete = collect(now);
    if (!busy_ && now >= next_) begin(now);
    if (!complete) return base::Error::kNotReady;
    return session_.sample();
  }
  [[nodiscard]] sensor::LinkState link() const { return absent_ ? sensor::LinkState::kAbsent : session_.link(); }
  [[nodiscard]] std::uint32_t dropped() const { return session_.dropped(); }
  [[nodiscard]] const Session& session() const { return session_; }

 private:
  /// The transfer that is next, or under way.
  enum class Step : std::uint8_t { kAsk, kCount, kRequest, kBytes, kCommand };

  static constexpr std::uint8_t kTransport = 0x10;
  static constexpr std::uint8_t kRead = 0x01;
  static constexpr std::uint8_t kWrite = 0x02;
  static constexpr std::uint8_t kAvailable = 0x03;
  static constexpr std::size_t kAround = 6;  ///< feature, command, length; two bytes of a checksum that is not checked
  static constexpr std::size_t kMaxData = bus::kMaxI2cTransfer - kAround;
  static constexpr std::uint16_t kMaxWaiting = 0x7FFF;             ///< a bus that nobody drives reads as ones
  static constexpr base::Duration kRest = base::milliseconds(2);   ///< as the vendor's library waits
  static constexpr base::Duration kPause = base::milliseconds(8);  ///< where nothing waits

  void begin(base::Time now) {
    const std::span<const std::uint8_t> command = session_.outbox().waiting();
    if (step_ == Step::kAsk && !command.empty()) step_ = Step::kCommand;
    std::array<std::uint8_t, bus::kMaxI2cTransfer> out{};
    std::size_t expected = 0;
    std::size_t size = kAround;
    switch (step_) {
      case Step::kAsk: put_header(out, kAvailable, 0); break;
      case Step::kRequest: put_header(out, kRead, chunk()); break;
      case Step::kCount: size = 0, expected = 2; break;
      case Step::kBytes: size = 0, expected = chunk(); break;
      case Step::kCommand: {
        const std::span<const std::uint8_t> part = command.first(std::min(command.size(), kMaxData));
        put_header(out, kWrite, part.size());
        std::copy(part.begin(), part.end(), out.begin() + 4);
        size += part.size();
        break;
      }
    }
    const base::Result<std::size_t> begun =
        bus_.begin(address_, std::span<const std::uint8_t>(out).first(size), expected);
    busy_ = begun.ok();
    if (!begun) fail(begun.error(), now);
  }

  static void put_header(std::span<std::uint8_t> out, std::uint8_t command, std::size_t length) {
    out[0] = kTransport;
    out[1] = command;
    out[2] = static_cast<std::uint8_t>(length >> 8U);
    out[3] = static_cast<std::uint8_t>(length & 0xFFU);
  }
  [[nodiscard]] std::size_t chunk() const { return std::min<std::size_t>(waiting_, bus::kMaxI2cTransfer); }

  // True once a frame is complete: there is one at most in a transfer.
  bool collect(base::Time now) {
    std::array<std::uint8_t, bus::kMaxI2cTransfer> in{};
    const base::Result<std::size_t> got = bus_.finish(in);
    if (!got && got.error() == base::Error::kNotReady) return false;
    busy_ = false;
    if (!got) return fail(got.error(), now), false;
    absent_ = false;
    next_ = now + kRest;
    bool complete = false;
    switch (step_) {
      case Step::kAsk: step_ = Step::kCount; break;
      case Step::kRequest: step_ = Step::kBytes; break;
      case Step::kCount:
        waiting_ = *got == 2 ? static_cast<std::uint16_t>(256U * in[0] + in[1]) : std::uint16_t{0};
        if (waiting_ > kMaxWaiting) waiting_ = 0;
        go_on(now);
        break;
      case Step::kBytes:
        for (const std::uint8_t byte : std::span<const std::uint8_t>(in).first(std::min(*got, in.size()))) {
          complete = session_.take(byte, now) || complete;
        }
        waiting_ = static_cast<std::uint16_t>(waiting_ - chunk());
        go_on(now);
        break;
      case Step::kCommand:
        session_.outbox().sent(std::min(session_.outbox().waiting().size(), kMaxData));
        step_ = Step::kAsk;
        break;
    }
    return complete && keep();
  }

  void go_on(base::Time now) {
    step_ = waiting_ > 0 ? Step::kRequest : Step::kAsk;
    if (waiting_ == 0) next_ = now + kPause;
  }

  bool keep() {
    const bool newer = !last_ || session_.sample().t > *last_;
    last_ = session_.sample().t;
    return newer;
  }

  void fail(base::Error error, base::Time now) {
    next_ = now + kPause;
    if (error == base::Error::kFull) return;
    step_ = Step::kAsk;
    const bool gone = error == base::Error::kGone;
    if (gone && !absent_) session_.link_lost();
    absent_ = gone;
  }

  Bus& bus_;
  std::uint8_t address_;
  Session session_;
  Step step_ = Step::kAsk;
  bool busy_ = false;
  bool absent_ = false;
  std::uint16_t waiting_ = 0;  ///< bytes that it has for us
  base::Time next_;
  std::optional<base::Time> last_;
};

static_assert(sensor::BlobCamera<Camera<serial::LinkArchetype>>);

}  // namespace fencepost::grove
