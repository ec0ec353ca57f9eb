// One serial line of an emulated board: a socket that the emulator connects to, with the pace of a real line.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>

#include "tests/boards/bench_clock.hpp"

namespace fencepost::test {

using WallClock = BenchClock;

class Line {
 public:
  /// Listens at `path`. Throws std::runtime_error if that cannot be.
  explicit Line(const std::string& path);
  ~Line();
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;

  /// The emulator has connected; false after `patience`.
  bool accept(std::chrono::milliseconds patience);

  /// Moves what the pace allows, and what has come. Never waits.
  void pump();
  void send(std::string_view bytes) { waiting_ += bytes; }
  [[nodiscard]] std::size_t waiting() const { return waiting_.size(); }
  /// Bytes that are sent and that the emulator has not read yet.
  [[nodiscard]] std::size_t unread() const;
  /// Bytes of the other side that wait in the socket.
  [[nodiscard]] std::size_t held() const;
  /// What has come since the last call.
  std::string take();

  /// Bytes a second; 115200 baud at first. Above 1e9: at once, also where no time passes.
  void set_pace(double pace) { pace_ = std::min(pace, fastest_); }
  /// Of an emulator that keeps the line's pace itself: what came faster would only wait there.
  void limit_pace(double fastest) {
    fastest_ = fastest;
    pace_ = fastest > 1e9 ? fastest : std::min(pace_, fastest);
  }
  /// The other side's bytes stay where they are.
  void block(bool blocked) { blocked_ = blocked; }
  void unsend() { waiting_.clear(); }
  [[nodiscard]] int socket() const { return connected_; }

 private:
  void write_some();
  void read_all();

  int listening_ = -1;
  int connected_ = -1;
  std::string waiting_;
  std::string heard_;
  double pace_ = 11'520;
  double fastest_ = 1e9;
  double allowed_ = 0;
  WallClock::time_point last_ = WallClock::now();
  bool blocked_ = false;
};

}  // namespace fencepost::test
