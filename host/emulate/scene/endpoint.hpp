// One emulated device with its cable: where frames, wheels, the host's bytes and the faults meet.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/emulate/models/device_model.hpp"
#include "host/emulate/models/messages.hpp"
#include "host/emulate/scene/feed.hpp"
#include "host/emulate/scene/image_fit.hpp"
#include "host/emulate/scene/travel.hpp"
#include "host/emulate/transport/line.hpp"

namespace fencepost::emulate {

/// One line to people.
using Say = std::function<void(const std::string& line)>;

/// The catalogue's data about the device on an endpoint.
struct EmulatedDevice {
  std::function<std::unique_ptr<DeviceModel>(const Colours& colours)> make;
  Describe describe = nullptr;       ///< its messages
  std::optional<ImageLimits> image;  ///< of cameras
  bool asked = false;                ///< a camera that says something only when asked, then of the newest image
  std::uint32_t baud = 0;            ///< 0: as fast as it goes
  std::size_t unit = 1;              ///< bytes that are lost or damaged as one
  bool host_seen = true;             ///< on CAN no host can be seen
};

struct EndpointSettings {
  std::string name;  ///< as it is called in messages
  EmulatedDevice device;
  FaultSettings faults;
  std::uint64_t seed = 1;
  Say trace;  ///< every command and reply; empty: none
};

struct EndpointCounts {
  std::uint64_t frames = 0;    ///< that the device saw
  std::uint64_t skipped = 0;   ///< came faster than its rate, or while its line was busy with the last one
  std::uint64_t commands = 0;  ///< bytes from the host
  std::uint64_t replies = 0;   ///< times it said something
};

/// All times are of one clock; calls come in order of time. While nobody is connected, output is lost.
class Endpoint {
 public:
  Endpoint(EndpointSettings settings, const Feed& feed, base::Time now);

  [[nodiscard]] const std::string& name() const { return settings_.name; }
  [[nodiscard]] const EmulatedDevice& device() const { return settings_.device; }
  /// Baud rate of the line, as the host has changed it; 0: as fast as it goes.
  [[nodiscard]] std::uint32_t baud() const { return baud_; }

  /// The host has opened or closed its end.
  void connect(bool connected, base::Time now);
  [[nodiscard]] bool connected() const { return connected_; }
  /// Whether an unplug fault is active.
  [[nodiscard]] bool unplugged() const { return unplugged_; }
  /// Connected, and its data was requested.
  [[nodiscard]] bool in_use() const;

  /// The host's bytes.
  void hear(std::span<const std::uint8_t> bytes, const Travel& travel, base::Time now);
  void see(const sensor::BlobFrame& frame, base::Time now);
  void pose(const sensor::OdometrySample& sample, base::Time now);
  /// Advances to `now`: bytes arrive, the device sends by itself, faults begin and end.
  void step(const Travel& travel, base::Time now);
  /// When `step` has something to do.
  [[nodiscard]] std::optional<base::Time> next_step() const;
  /// Bytes that have arrived at the host; next_to_host: when the next one does.
  Bytes to_host(base::Time now);
  [[nodiscard]] std::optional<base::Time> next_to_host() const { return line_.next_to_host(); }

  /// The line is full: read nothing from the host until it drains.
  [[nodiscard]] bool full() const { return line_.full(); }

  /// From now on the faults that have a period come.
  void begin(base::Time now);

  [[nodiscard]] const FaultCounts& faults() const { return line_.counts(); }
  [[nodiscard]] const EndpointCounts& counts() const { return counts_; }
  /// Requests of the hosts that the device does not carry out, each name once.
  [[nodiscard]] std::vector<std::string> not_emulated() const { return model_->not_emulated(); }
  /// Nothing for what is no camera.
  [[nodiscard]] const std::optional<ImageFit>& fit() const { return fit_; }

 private:
  void say(const Bytes& bytes, base::Time now);
  void trace(bool from_host, std::span<const std::uint8_t> bytes, base::Time now) const;
  void take_arrived(base::Time now);
  void reboot_if_due(base::Time now);
  void unplug_if_due(base::Time now);

  EndpointSettings settings_;
  std::unique_ptr<DeviceModel> model_;
  Line line_;
  std::optional<ImageFit> fit_;
  base::Duration frame_period_;
  std::optional<base::Time> next_frame_;
  std::optional<base::Time> next_reboot_;
  std::optional<base::Time> next_plug_;  ///< the next time the line is hung up, or comes back
  std::uint32_t baud_;
  bool connected_ = false;
  bool unplugged_ = false;
  EndpointCounts counts_;
};

}  // namespace fencepost::emulate
