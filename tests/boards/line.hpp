// One serial line of an emulated board, with the pace of a real one.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>

namespace fencepost::test {

using WallClock = std::chrono::steady_clock;

/// Who carries the bytes to the emulator is the derived class's business.
class Line {
 public:
  virtual ~Line() = default;

  /// Moves what the pace allows, and what has come. Never waits. `now`: seconds by the machine's clock.
  void pump(double now);
  void send(std::string_view bytes) { waiting_ += bytes; }
  [[nodiscard]] std::size_t waiting() const { return waiting_.size(); }
  /// Bytes that are sent and that the emulator has not read yet.
  [[nodiscard]] virtual std::size_t unread() const = 0;
  /// Bytes of the other side that wait to be taken.
  [[nodiscard]] virtual std::size_t held() const = 0;
  /// The bytes that came since the last call.
  std::string take();

  /// Bytes a second; 115200 baud at first.
  void set_pace(double pace) { pace_ = std::min(pace, fastest_); }
  /// Where the emulator keeps the line's pace itself, what came faster would only wait there.
  void limit_pace(double fastest) { set_pace(fastest_ = fastest); }
  /// The other side's bytes stay where they are.
  void block(bool blocked) { blocked_ = blocked; }
  [[nodiscard]] bool blocked() const { return blocked_; }
  void unsend() { waiting_.clear(); }

 protected:
  /// Takes bytes from the front; how many.
  virtual std::size_t put(std::string_view bytes) = 0;
  /// The bytes that the board has sent, at most `most`.
  virtual std::string get(std::size_t most) = 0;

 private:
  std::string waiting_;
  std::string heard_;
  double pace_ = 11'520;
  double fastest_ = std::numeric_limits<double>::infinity();
  double allowed_ = 0;
  double last_ = 0;
  bool blocked_ = false;
};

/// A socket that the emulator connects to.
class SocketLine : public Line {
 public:
  /// Listens at `path`. Throws std::runtime_error if that cannot be.
  explicit SocketLine(const std::string& path);
  ~SocketLine() override;
  SocketLine(const SocketLine&) = delete;
  SocketLine& operator=(const SocketLine&) = delete;

  /// The emulator has connected; false after `patience`.
  bool accept(std::chrono::milliseconds patience);
  /// The board has sent something, or hung up; false after `patience`.
  bool await(std::chrono::milliseconds patience);
  [[nodiscard]] std::size_t unread() const override;
  [[nodiscard]] std::size_t held() const override;

 private:
  std::size_t put(std::string_view bytes) override;
  std::string get(std::size_t most) override;

  int listening_ = -1;
  int connected_ = -1;
};

}  // namespace fencepost::test
