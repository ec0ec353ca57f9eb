// A Pixy2 on a pseudo-terminal, in a mood, and the doctor's look at a camera.
#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "hal/linux/clock.hpp"
#include "host/devices/device_spec.hpp"
#include "host/doctor/ports/probe.hpp"
#include "host/emulate/models/pixy2.hpp"
#include "host/emulate/transport/transport.hpp"

namespace fencepost::host::testing {

inline const doctor::ProbeTimes kQuick{base::milliseconds(600), base::milliseconds(200), base::milliseconds(300)};

/// `text`: a camera as on the command line.
inline doctor::Findings examined(const std::string& text, const doctor::Identity& who = doctor::Identity::own()) {
  const auto spec = devices::parse_device(text, devices::Use::kCamera);
  EXPECT_TRUE(spec.ok()) << spec.error();
  return doctor::examine_device(*spec, {}, {}, who, kQuick, [] { return false; });
}

/// The emulated camera on a pseudo-terminal: one that hears nothing at another baud than its own.
class FakePixy2 {
 public:
  enum class Mood : std::uint8_t { kSeesOne, kSeesNothing, kBusy };
  FakePixy2(const std::string& path, Mood mood, std::uint32_t baud = 0)
      : transport_(std::move(*emulate::open_pty(path))), mood_(mood), baud_(baud), thread_([this] { serve(); }) {}
  ~FakePixy2() {
    stop_ = true;
    thread_.join();
  }
  FakePixy2(const FakePixy2&) = delete;
  FakePixy2& operator=(const FakePixy2&) = delete;

 private:
  void serve() {
    const linux::MonotonicClock clock;
    emulate::Pixy2 camera(base::Time{} - base::milliseconds(10'000));
    camera.hold_button(mood_ == Mood::kBusy);
    base::Time shown;
    while (!stop_) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      if (!transport_->tend()) continue;
      const emulate::Bytes heard = transport_->read();
      if (baud_ != 0 && transport_->host_baud() != baud_) continue;
      if (clock.now() - shown > base::milliseconds(16)) {
        shown = clock.now();
        sensor::Blob blob;
        blob.signature = 1;
        blob.x2 = 20;
        blob.y2 = 30;
        camera.show(std::vector<sensor::Blob>(mood_ == Mood::kSeesOne ? 1 : 0, blob));
      }
      for (const std::uint8_t byte : heard) {
        const emulate::Bytes reply = camera.take(byte, clock.now());
        if (!reply.empty()) transport_->write(reply);
      }
    }
  }

  std::unique_ptr<emulate::Transport> transport_;
  Mood mood_;
  std::uint32_t baud_;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

}  // namespace fencepost::host::testing
