// A Pixy2 and a Create 2 on pseudo-terminals, driving towards a post, each in a thread of its own.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "hal/linux/clock.hpp"
#include "host/emulate/models/create.hpp"
#include "host/emulate/models/pixy2.hpp"
#include "tests/hal/linux/pty.hpp"

namespace fencepost::host::testing {

/// Something that talks on the far end of a serial line; it can be unplugged and plugged in again.
class FakeDevice {
 public:
  using Bytes = std::string;
  /// Gets what was heard since the last call, at most a few milliseconds ago, and answers what to say.
  using Turn = std::function<Bytes(const Bytes& heard, base::Time now)>;

  FakeDevice(const std::string& path, Turn turn) : far_(path), turn_(std::move(turn)), thread_([this] { work(); }) {}
  ~FakeDevice() {
    stop_ = true;
    thread_.join();
  }
  FakeDevice(const FakeDevice&) = delete;
  FakeDevice& operator=(const FakeDevice&) = delete;

  void unplug() {
    const std::lock_guard lock(mutex_);
    far_.unplug();
  }
  void plug() {
    const std::lock_guard lock(mutex_);
    far_.plug();
  }

 private:
  void work() {
    while (!stop_) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      const std::lock_guard lock(mutex_);
      if (far_.descriptor() >= 0) exchange();
    }
  }

  void exchange() {
    std::array<char, 4096> buffer{};
    const ssize_t count = ::read(far_.descriptor(), buffer.data(), buffer.size());
    const Bytes heard(buffer.data(), count > 0 ? static_cast<std::size_t>(count) : 0);
    const Bytes said = turn_(heard, clock_.now());
    if (!said.empty()) static_cast<void>(!::write(far_.descriptor(), said.data(), said.size()));
  }

  std::mutex mutex_;  ///< of the far end
  linux::FarEnd far_;
  linux::MonotonicClock clock_;
  Turn turn_;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

/// How far the robot has come: 0.04 m/s for 20 s, then it stands; or as its wheels were driven.
using Way = std::function<double(base::Time)>;
inline double scripted_way(base::Time now) { return std::min(now.to_double(), 20.0) * 0.04; }

/// A red post 0.1 m wide, its front 1 m ahead of where the robot starts; the camera is above the robot's middle.
/// 50 frames a second.
class FakePixy {
 public:
  explicit FakePixy(const std::string& path, Way way = scripted_way)
      : way_(std::move(way)),
        device_(path, [this](const std::string& heard, base::Time now) { return turn(heard, now); }) {}
  FakeDevice& device() { return device_; }

 private:
  std::string turn(const std::string& heard, base::Time now) {
    if (now >= next_frame_) {
      next_frame_ = now + base::milliseconds(20);
      camera_.show({post(way_(now))});
    }
    std::string said;
    for (const char c : heard) {
      const auto answer = camera_.take(static_cast<std::uint8_t>(c), now);
      said.append(answer.begin(), answer.end());
    }
    return said;
  }

  static sensor::Blob post(double x) {
    const double depth = 1 - x;
    sensor::Blob blob;
    blob.signature = 1;
    blob.x1 = static_cast<std::int16_t>(157.5 - 273.66 * 0.05 / depth);
    blob.x2 = static_cast<std::int16_t>(157.5 + 273.66 * 0.05 / depth);
    blob.y1 = 100;
    blob.y2 = static_cast<std::int16_t>(std::min(200.0, 103.5 + 273.66 * 0.12 / depth));
    return blob;
  }

  emulate::Pixy2 camera_{base::Time{} - base::milliseconds(5'000)};  // has started long ago
  base::Time next_frame_;
  Way way_;
  FakeDevice device_;  ///< last: its thread uses the others
};

class FakeCreate {
 public:
  explicit FakeCreate(const std::string& path)
      : device_(path, [this](const std::string& heard, base::Time now) { return turn(heard, now); }) {}
  FakeDevice& device() { return device_; }
  /// Somebody drives it: what its wheels do, mm/s, how far they brought it, m, and its mode.
  [[nodiscard]] int speed() const { return speed_; }
  [[nodiscard]] double driven_way() const { return driven_way_; }
  [[nodiscard]] int mode() const { return mode_; }

 private:
  std::string turn(const std::string& heard, base::Time now) {
    if (!on_) said_ = robot_.power_up();
    on_ = true;
    std::string said = robot_.feed(heard);
    speed_ = robot_.speeds().left;
    mode_ = robot_.mode();
    if (now < next_frame_) return said;
    next_frame_ = now + base::milliseconds(15);
    if (robot_.driven()) {
      robot_.drive_on(0.015);
      driven_way_ = driven_way_ + speed_ * 15e-6;
      return said + robot_.frame();
    }
    // 508.8 counts a revolution of a wheel 72 mm across.
    const int counts = static_cast<int>(scripted_way(now) * 508.8 / (3.14159265 * 0.072));
    robot_.roll(counts - counts_, counts - counts_);
    counts_ = counts;
    return said + robot_.frame();
  }

  emulate::CreateDevice robot_{emulate::CreateModel::kTwo, true};
  bool on_ = false;
  std::string said_;
  int counts_ = 0;
  std::atomic<int> speed_ = 0;
  std::atomic<int> mode_ = 0;
  std::atomic<double> driven_way_ = 0;
  base::Time next_frame_;
  FakeDevice device_;
};

}  // namespace fencepost::host::testing
