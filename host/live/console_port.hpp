// Where the console of `fencepost run` is: this terminal, a serial port, a connection, or a pseudo-terminal of its own.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "hal/base/result.hpp"
#include "hal/linux/descriptor.hpp"
#include "hal/linux/wait.hpp"
#include "host/live/place.hpp"
#include "host/live/port.hpp"
#include "host/live/write_behind.hpp"
#include "host/text/printable.hpp"

namespace fencepost::host {

struct ConsoleSpec {
  enum class Kind : std::uint8_t { kTerminal, kPty, kListen, kLine };
  Kind kind = Kind::kTerminal;
  Place place;  ///< of a line: tty or tcp; where it listens: tcp
  std::uint32_t baud = 115'200;
};

/// "-" this terminal, "pty", tcp:HOST:PORT, tcp-listen:[HOST:]PORT (this machine alone without HOST), or the path of a
/// serial port with ",baud=N" behind it. errors: a sentence that says what is wrong and what is allowed.
base::Result<ConsoleSpec, std::string> parse_console(std::string_view text);

/// A byte port to people. Output that cannot be written is not kept indefinitely: see PatientConsole.
class ConsolePort : public BytePort {
 public:
  /// Why nothing that is written will ever arrive: a sentence, such as that the reader has gone or the disk is full.
  [[nodiscard]] virtual std::optional<std::string> lost() const { return std::nullopt; }
  /// Waits until everything accepted has been written, as long as something is written every `patience`. Returns the
  /// bytes that will never be.
  virtual std::uint64_t finish(std::chrono::milliseconds /*patience*/) { return 0; }
  /// The input is a file or a pipe, which waits until it is read.
  [[nodiscard]] virtual bool input_waits() const { return false; }
  /// The input has ended.
  [[nodiscard]] virtual bool ended() const { return false; }
  /// Adds the descriptors that wake the loop: at input, and when there is room again for waiting output.
  virtual void watch(linux::WaitSet& set, bool output_waits) const;
};

/// Standard input and output. Reading stops at the end of input, and while the program is in the background. A terminal
/// gets no control characters but line ends. A file is written by a thread beside the loop, for its disk may be slow.
class TerminalConsole final : public ConsolePort {
 public:
  TerminalConsole(int input, int output);
  base::Result<std::size_t> read(std::span<std::uint8_t> in) override;
  base::Result<std::size_t> write(std::span<const std::uint8_t> out) override;
  void tend(base::Time now) override { now_ = now; }
  [[nodiscard]] bool connected() const override { return !lost(); }
  [[nodiscard]] std::string problem() const override { return lost().value_or(std::string()); }
  [[nodiscard]] int descriptor() const override;
  [[nodiscard]] std::optional<std::string> lost() const override;
  std::uint64_t finish(std::chrono::milliseconds patience) override;
  [[nodiscard]] bool input_waits() const override { return !input_is_terminal_; }
  [[nodiscard]] bool ended() const override { return ended_; }
  void watch(linux::WaitSet& set, bool output_waits) const override;

 private:
  [[nodiscard]] bool may_read() const;
  base::Result<std::size_t> write_file(std::string_view bytes);
  ssize_t write_some(std::string_view bytes);
  ssize_t write_terminal(std::string_view bytes);

  int input_;
  int output_;
  bool input_is_terminal_;
  bool output_is_terminal_;
  bool ended_ = false;
  int error_ = 0;         ///< of writing, for good
  PrintableBytes shown_;  ///< on a terminal
  base::Time now_;
  std::optional<WriteBehind> file_;
};

/// A new pseudo-terminal, to be opened at `path`.
class PtyConsole final : public ConsolePort {
 public:
  /// errors: DeviceFailure
  static std::unique_ptr<PtyConsole> open();
  [[nodiscard]] const std::string& path() const { return path_; }

  base::Result<std::size_t> read(std::span<std::uint8_t> in) override;
  base::Result<std::size_t> write(std::span<const std::uint8_t> out) override;
  void tend(base::Time /*now*/) override {}
  [[nodiscard]] bool connected() const override { return true; }
  [[nodiscard]] std::string problem() const override { return {}; }
  [[nodiscard]] int descriptor() const override { return master_.get(); }

 private:
  PtyConsole(linux::Descriptor master, linux::Descriptor slave, std::string path)
      : master_(std::move(master)), slave_(std::move(slave)), path_(std::move(path)) {}

  linux::Descriptor master_;
  linux::Descriptor slave_;  ///< kept open: a master without a slave is hung up
  std::string path_;
};

/// A serial port or a connection.
class LineConsole final : public ConsolePort {
 public:
  explicit LineConsole(std::unique_ptr<BytePort> port) : port_(std::move(port)) {}
  base::Result<std::size_t> read(std::span<std::uint8_t> in) override { return port_->read(in); }
  base::Result<std::size_t> write(std::span<const std::uint8_t> out) override { return port_->write(out); }
  void tend(base::Time now) override { port_->tend(now); }
  [[nodiscard]] bool connected() const override { return port_->connected(); }
  [[nodiscard]] std::string problem() const override { return port_->problem(); }
  [[nodiscard]] int descriptor() const override { return port_->descriptor(); }

 private:
  std::unique_ptr<BytePort> port_;
};

/// The loop's link. Output is discarded while the line is gone and resumes with a whole line. With `may_lose`, output
/// that was not accepted for a second is discarded too. That is for a console in mode log beside a log on disk: it must
/// not hold up the robot because nobody reads it. Without a log on disk such a console is the log: inputs are refused
/// rather than lost.
class PatientConsole {
 public:
  PatientConsole(ConsolePort& port, bool may_lose) : port_(port), may_lose_(may_lose) {}

  base::Result<std::size_t> read(std::span<std::uint8_t> in) { return port_.read(in); }
  base::Result<std::size_t> write(std::span<const std::uint8_t> out);
  void tend(base::Time now);
  /// Bytes discarded.
  [[nodiscard]] std::uint64_t lost() const { return lost_; }
  /// Time since which it has taken none of the waiting output.
  [[nodiscard]] base::Duration stuck() const { return stuck_since_ ? now_ - *stuck_since_ : base::Duration{}; }

 private:
  static constexpr base::Duration kPatience = base::milliseconds(1'000);

  std::size_t send(std::span<const std::uint8_t> out);
  std::size_t discard(std::span<const std::uint8_t> out);
  std::size_t resume(std::span<const std::uint8_t> out);

  ConsolePort& port_;
  bool may_lose_;
  base::Time now_;
  std::optional<base::Time> stuck_since_;
  bool discarding_ = false;
  bool line_begun_ = false;  ///< the last byte that went out ended no line
  bool cut_begun_ = false;   ///< the last byte thrown away ended no line
  std::uint64_t lost_ = 0;
};
static_assert(bus::ByteLink<PatientConsole>);

/// errors: DeviceFailure
std::unique_ptr<ConsolePort> open_console(const ConsoleSpec& spec, bool wait);

}  // namespace fencepost::host
