// A Game Boy Advance in this process: libmgba, whose clock is the machine's.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "hal/boards/gba/mailbox.hpp"
#include "tests/boards/emulator.hpp"
#include "tests/boards/gba/link_port.hpp"

struct mCore;

namespace fencepost::test {

/// The console through the mailbox in the board's memory.
class MailboxLine : public Line {
 public:
  void connect(board::Mailbox& mailbox);

  [[nodiscard]] std::size_t unread() const override { return mailbox_->desk_sent - mailbox_->board_received; }
  [[nodiscard]] std::size_t held() const override { return mailbox_->board_sent - mailbox_->desk_received; }

 private:
  std::size_t put(std::string_view bytes) override;
  std::string get(std::size_t most) override;

  board::Mailbox* mailbox_ = nullptr;
};

class Handheld : public Machine {
 public:
  static constexpr std::size_t kWidth = 240;
  static constexpr std::size_t kHeight = 160;
  struct Pixel {
    std::uint8_t red = 0;
    std::uint8_t green = 0;
    std::uint8_t blue = 0;
    friend bool operator==(const Pixel&, const Pixel&) = default;
  };
  enum Key : unsigned { kA = 1, kB = 2, kSelect = 4, kStart = 8 };

  /// Fills the work memory on the chip before the start; used stack has other values.
  static constexpr std::uint8_t kPaint = 0xA5;
  enum class Console { kMailbox, kLinkPort };

  /// `image`: a .gba file. `save`: what the cartridge's battery kept, and keeps. Throws std::runtime_error.
  explicit Handheld(const std::string& image, std::vector<std::uint8_t>* save = nullptr,
                    Console console = Console::kMailbox);
  ~Handheld() override;
  Handheld(const Handheld&) = delete;
  Handheld& operator=(const Handheld&) = delete;

  Line& line(std::size_t /*n*/) override;
  [[nodiscard]] LinkPort& link_port() { return link_port_; }
  bool alive() override { return true; }
  void pump() override;
  [[nodiscard]] double seconds() const override;

  void hold(unsigned keys);
  [[nodiscard]] Pixel pixel(std::size_t x, std::size_t y) const;
  /// Throws std::runtime_error.
  void save_picture(const std::string& path) const;

  /// Work memory on the chip, 32 KB from 0x03000000.
  [[nodiscard]] std::span<std::uint8_t> fast_memory();
  /// Called after each instruction, with the address of the next one and where a function that begins there returns to.
  using Watch = std::function<void(std::uint32_t next, std::uint32_t returns_to)>;
  void watch(Watch watch) { watch_ = std::move(watch); }
  [[nodiscard]] std::uint64_t cycles() const;

 private:
  void run_until(double seconds);
  void step();
  void connect_link_port();

  mCore* core_ = nullptr;
  std::vector<std::uint32_t> picture_ = std::vector<std::uint32_t>(kWidth * kHeight);
  std::vector<std::uint8_t>* save_ = nullptr;
  Console kind_;
  MailboxLine mailbox_;
  LinkPort link_port_;
  Watch watch_;
};

}  // namespace fencepost::test
