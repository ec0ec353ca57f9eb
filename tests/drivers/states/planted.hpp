// A decoder with a fault planted behind its checksum, for the walk and the fuzzer to find.
#pragma once

#include "hal/base/crc16.hpp"
#include "tests/drivers/states/scanned.hpp"

namespace fencepost::test {

inline constexpr std::size_t kPlantedRoom = 24;

inline constexpr std::size_t kPlantedLine = kPlantedRoom + 8;

/// Lines `$<payload>*<CRC, four digits>`. Takes payloads of `Bound` characters and keeps lines of `Line`, without
/// regard to the room. With one more than kPlantedRoom or kPlantedLine the last one falls on a canary.
template <std::size_t Bound, std::size_t Line = kPlantedLine>
class Planted {
 public:
  /// True: payload() is new.
  bool feed(std::uint8_t byte) {
    const char c = static_cast<char>(byte);
    if (c == '$') size_ = 0, in_line_ = true;
    if (!in_line_) return false;
    if (c == '\n') return end_line();
    if (size_ < Line) {
      line_[size_++] = c;
    } else {
      in_line_ = false;
    }
    return false;
  }
  void reset() { in_line_ = false; }

  [[nodiscard]] std::size_t size() const { return in_line_ ? size_ : 0; }
  [[nodiscard]] std::string_view payload() const { return {payload_.data(), payload_size_}; }
  [[nodiscard]] bool intact() const { return payload_.back() == kCanary && line_.back() == kCanary; }

 private:
  static constexpr char kCanary = '\x5A';
  static constexpr std::size_t kAround = 6;

  template <std::size_t Size>
  static constexpr std::array<char, Size> guarded() {
    std::array<char, Size> room{};
    room.back() = kCanary;
    return room;
  }

  bool end_line() {
    in_line_ = false;
    if (size_ < kAround || size_ > kAround + Bound || line_[size_ - 5] != '*') return false;
    const std::string_view body(line_.data() + 1, size_ - kAround);
    unsigned crc = 0;
    for (std::size_t i = size_ - 4; i < size_; ++i) {
      const std::size_t digit = std::string_view("0123456789ABCDEF").find(line_[i]);
      if (digit > 15) return false;
      crc = 16 * crc + static_cast<unsigned>(digit);
    }
    if (crc != base::crc16(body)) return false;
    std::copy(body.begin(), body.end(), payload_.begin());
    payload_size_ = body.size();
    return true;
  }

  bool in_line_ = false;
  std::size_t size_ = 0;
  std::array<char, kPlantedLine + 1> line_ = guarded<kPlantedLine + 1>();
  std::size_t payload_size_ = 0;
  std::array<char, kPlantedRoom + 1> payload_ = guarded<kPlantedRoom + 1>();
};

template <std::size_t Bound, std::size_t Line = kPlantedLine>
struct PlantedSubject : Seen {
  void feed(std::uint8_t byte) {
    right = decoder.feed(byte);
    if (!decoder.intact()) trouble = "written behind its room";
    if (!right) return;
    ++outputs;
    right = decoder.payload() == "hello";
  }
  void rest() { decoder.reset(); }
  [[nodiscard]] bool idle() const { return decoder.size() == 0; }
  void control(Key& key) const { key.u16(static_cast<std::uint16_t>(decoder.size())); }

  Planted<Bound, Line> decoder;
};

inline Plan planted_plan() {
  const auto line = [](std::size_t size) {
    return sealed(Bytes{'$'} + Bytes(size, 'x') + text("*0000\n"), seal_records);
  };
  Plan plan;
  plan.good = sealed(text("$hello*0000\n"), seal_records);
  plan.way_back = plan.good.size();
  plan.shortest = 7;
  plan.samples = {{plan.good}, {line(0)}, {line(1)}, {line(kPlantedRoom)}, {line(kPlantedRoom + 1), 0}};
  return plan;
}

}  // namespace fencepost::test
