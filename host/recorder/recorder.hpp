// Records a robot's console: to the file first, then onto the screen; what is typed goes the other way.
#pragma once

#include <array>
#include <csignal>
#include <optional>
#include <string>

#include "hal/linux/clock.hpp"
#include "hal/linux/wait.hpp"
#include "host/live/log_file.hpp"
#include "host/live/port.hpp"
#include "host/recorder/display.hpp"
#include "host/recorder/keyboard.hpp"
#include "host/recorder/tally.hpp"

namespace fencepost::host {

struct RecorderSettings {
  std::string port_name;  ///< for messages
  /// Sent when the port is there, each time it is there again, and a few times more until a record comes. Many boards
  /// restart when their port is opened, and miss the first greeting. Empty: nothing is sent.
  std::string greeting;
  bool ends_with_port = false;  ///< a pipe's end is the end; a serial port is waited for
  std::optional<base::Duration> length{};
};

struct RecordingEnd {
  int signal = 0;        ///< that ended it, or 0
  LogFile::Fault fault;  ///< of the file: it holds what came before
};

class Recorder {
 public:
  /// All that it borrows must outlive it. Without a keyboard only the greeting is sent.
  struct Parts {
    BytePort& port;
    LogFile& log;
    Display& display;
    Keyboard* keyboard;
    const volatile std::sig_atomic_t& interrupted;  ///< not 0: the signal that ends it
    int interrupted_descriptor;                     ///< readable then, for WaitSet; or -1
    const linux::MonotonicClock& clock;
  };
  Recorder(const Parts& parts, RecorderSettings settings);

  /// Until a signal, the end of the input, the length, or a fault of the file. Closes the file.
  RecordingEnd run();
  [[nodiscard]] const Tally& tally() const { return tally_; }

 private:
  void turn();
  [[nodiscard]] bool over() const;
  void watch_connection();
  void connected();
  void lost();
  void receive();
  void keep(std::string_view bytes);
  void take_typed();
  void send();
  void greet_again();
  void hint();
  void show_status();
  void sleep();
  RecordingEnd end();

  Parts parts_;
  RecorderSettings settings_;
  base::Time now_;
  Tally tally_;
  LogFile::Fault fault_;
  std::array<std::uint8_t, 16384> buffer_{};
  std::string outgoing_;
  bool connected_ = false;
  bool was_connected_ = false;
  base::Time connected_at_;
  base::Time greeted_at_;
  base::Time status_at_;
  int greetings_ = 0;
  std::uint64_t bytes_then_ = 0;    ///< when it was connected last
  std::uint32_t records_then_ = 0;  ///< likewise
  bool hinted_ = false;
  bool within_line_ = false;
};

}  // namespace fencepost::host
