// The link port's UART as GBATEK describes it (SIO UART Mode), which libmgba leaves out: four bytes each way, by the
// emulator's clock. It raises no interrupt: the image must not need one.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>

#include "tests/boards/line.hpp"

namespace fencepost::test {

class LinkPort : public Line {
 public:
  static constexpr std::uint32_t kControl = 0x0400'0128;
  static constexpr std::uint32_t kData = 0x0400'012A;

  /// The core's accesses; `now`: its cycles.
  std::uint16_t read(std::uint32_t address, std::uint64_t now);
  void write(std::uint32_t address, std::uint16_t value, std::uint64_t now);
  /// Lets bytes move until now.
  void advance(std::uint64_t now);

  /// Bytes that came while the part could hold no more.
  [[nodiscard]] std::size_t overruns() const { return overruns_; }
  [[nodiscard]] std::size_t unread() const override { return cable_.size() + received_.size(); }
  [[nodiscard]] std::size_t held() const override { return sent_.size(); }

 private:
  static constexpr std::size_t kFifo = 4;

  std::size_t put(std::string_view bytes) override;
  std::string get(std::size_t most) override;
  void receive_one();
  [[nodiscard]] bool enabled(std::uint16_t bit) const {
    return (control_ & 0x3000U) == 0x3000U && (control_ & bit) != 0;
  }
  [[nodiscard]] std::uint64_t byte_cycles() const;

  std::uint16_t control_ = 0;
  std::deque<std::uint8_t> cable_;     // on its way to the part
  std::deque<std::uint8_t> received_;  // in the part
  std::deque<std::uint8_t> sending_;   // in the part
  std::string sent_;
  std::uint64_t next_received_ = 0;
  std::uint64_t next_sent_ = 0;
  bool fault_ = false;
  std::size_t overruns_ = 0;
};

}  // namespace fencepost::test
