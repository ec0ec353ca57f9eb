// A byte link that carries the serial packets over the USB pipe.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "drivers/chirp/chirp.hpp"
#include "drivers/pixy2/protocol.hpp"
#include "drivers/wire/flush.hpp"
#include "drivers/wire/scanner.hpp"
#include "hal/bus/byte_link.hpp"

namespace fencepost::pixy2 {

/// `Usb`: the bulk pipe, whose writes are transfers. Packets written here become calls of `ser_packet`, and what those
/// return becomes packets with checksum, so the camera's driver is the same on all links. The user repeats
/// unanswered requests: one that comes too early opens the connection instead, and one after three unanswered ones
/// opens it again.
template <bus::ByteLink Usb>
class ChirpLink {
 public:
  explicit ChirpLink(Usb& usb) : usb_(usb) {}

  base::Result<std::size_t> write(std::span<const std::uint8_t> out) {
    for (const std::uint8_t byte : out) {
      requests_.feed(byte, {}, [&](std::span<const std::uint8_t> message, base::Time) { take_request(message); });
    }
    if (!wire::flush(outbox_, usb_)) return lose();
    return out.size();
  }

  base::Result<std::size_t> read(std::span<std::uint8_t> in) {
    if (!wire::flush(outbox_, usb_)) return lose();
    if (next_ == reply_.size()) {
      if (!receive()) return lose();
    }
    const std::size_t count = std::min(in.size(), reply_.size() - next_);
    if (count == 0) return base::Error::kNotReady;
    std::copy_n(reply_.begin() + static_cast<std::ptrdiff_t>(next_), count, in.begin());
    next_ += count;
    return count;
  }

 private:
  enum class Phase : std::uint8_t { kClosed, kInitialised, kOpen };
  static constexpr std::uint8_t kUnansweredToClose = 3;
  static constexpr int kReads = 8;

  // False: gone. Ends with the first packet: the one before must have been read.
  bool receive() {
    std::array<std::uint8_t, chirp::kTransfer> bytes{};
    for (int i = 0; i < kReads && next_ == reply_.size(); ++i) {
      const base::Result<std::size_t> got = usb_.read(bytes);
      if (!got) return got.error() != base::Error::kGone;
      for (std::size_t k = 0; k < *got; ++k) {
        messages_.feed(bytes[k], {}, [&](std::span<const std::uint8_t> message, base::Time) { take_message(message); });
      }
    }
    return wire::flush(outbox_, usb_);
  }

  void send(const chirp::Transfer& transfer) { wire::replace(outbox_, transfer.view()); }

  void take_request(std::span<const std::uint8_t> message) {
    // One request at a time: a message that is not whole yet answers none any more, and would swallow the next.
    messages_.reset();
    // In each phase: a camera that was switched off and on has lost its state.
    if (phase_ != Phase::kClosed && unanswered_++ >= kUnansweredToClose) phase_ = Phase::kClosed;
    switch (phase_) {
      case Phase::kClosed: return send(chirp::initialise());
      case Phase::kInitialised: return send(chirp::enumerate("ser_packet"));
      case Phase::kOpen: return send(chirp::call(procedure_, message[2], message.subspan(kHeader)));
    }
  }

  void take_message(std::span<const std::uint8_t> bytes) {
    const std::optional<chirp::Message> message = chirp::message_in(bytes);
    if (!message) return;
    if (message->type == chirp::Type::kInitialised && phase_ == Phase::kClosed && message->result == 0) {
      phase_ = Phase::kInitialised;
      unanswered_ = 0;
      send(chirp::enumerate("ser_packet"));
    } else if (message->type == chirp::Type::kEnumerated && phase_ == Phase::kInitialised && message->result >= 0) {
      phase_ = Phase::kOpen;
      unanswered_ = 0;
      procedure_ = static_cast<std::uint16_t>(message->result);
    } else if (message->type == chirp::Type::kResponse && phase_ == Phase::kOpen) {
      if (const std::optional<chirp::Packet> packet = chirp::packet_in(*message)) give(*packet);
    }
  }

  void give(const chirp::Packet& packet) {
    unanswered_ = 0;
    reply_.clear();
    next_ = 0;
    unsigned sum = 0;
    for (const std::uint8_t byte : packet.data) sum += byte;
    const auto length = static_cast<std::uint8_t>(packet.data.size());
    for (const std::uint8_t byte : {kSync, kSecondSync, packet.type, length, static_cast<std::uint8_t>(sum & 0xFFU),
                                    static_cast<std::uint8_t>(sum >> 8U & 0xFFU)}) {
      (void)reply_.push_back(byte);
    }
    for (const std::uint8_t byte : packet.data) (void)reply_.push_back(byte);
  }

  base::Error lose() {
    phase_ = Phase::kClosed;
    outbox_.clear();
    messages_.reset();
    requests_.reset();
    return base::Error::kGone;
  }

  Usb& usb_;
  Phase phase_ = Phase::kClosed;
  std::uint16_t procedure_ = 0;
  std::uint8_t unanswered_ = 0;
  wire::Scanner<kHeader + kProgramName, examine_request> requests_;
  wire::Scanner<chirp::kLongest, chirp::examine> messages_;
  serial::Outbox<chirp::kTransfer> outbox_;
  base::FixedVector<std::uint8_t, kLongestPacket> reply_;
  std::size_t next_ = 0;
};

}  // namespace fencepost::pixy2
