// One row of the catalogue: all that the program knows of a device.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "hal/linux/clock.hpp"
#include "hal/sensor/camera.hpp"
#include "host/emulate/models/device_model.hpp"
#include "host/emulate/models/messages.hpp"
#include "host/emulate/models/wheel_adapters.hpp"
#include "host/emulate/scene/image_fit.hpp"
#include "host/live/brick.hpp"
#include "host/live/device.hpp"
#include "host/live/open_port.hpp"
#include "host/live/place.hpp"
#include "host/live/robot_file.hpp"

namespace fencepost::devices {

using host::PlaceKind;

inline bool has(const std::vector<PlaceKind>& places, PlaceKind place) {
  return std::find(places.begin(), places.end(), place) != places.end();
}

struct DeviceSpec;

enum class Role : std::uint8_t { kCamera, kOdometry };

/// A member without a default: a row that leaves it out does not compile.
template <class T>
class Given {
 public:
  template <class U>
  requires std::convertible_to<U, T>
  constexpr Given(U&& value) : value_(std::forward<U>(value)) {}  // NOLINT(google-explicit-constructor): rows read so
  Given(std::nullptr_t) = delete;

  constexpr const T& operator*() const { return value_; }
  constexpr const T* operator->() const { return &value_; }

 private:
  T value_;
};

/// Allowed values of an option.
struct Words {
  std::vector<std::string> words;
};
struct Whole {
  std::uint32_t low = 0;
  std::uint32_t high = 0;
  bool or_zero = false;
};
struct Metres {
  double below = 0;  ///< more than 0
};
struct AnyText {};
using Values = std::variant<Words, Whole, Metres, AnyText>;

struct Option {
  Given<std::string> name;
  Given<Values> values;
  Given<std::string> fallback;         ///< as it would be written; empty: there is none
  std::string help = {};               ///< its meaning, where its name does not say it
  std::vector<PlaceKind> places = {};  ///< where it makes sense; none: everywhere
};

/// Arguments of opening a driver, all borrowed.
struct Opening {
  const DeviceSpec& spec;
  const host::RobotFile& robot;
  const std::shared_ptr<host::SharedBrick>& brick;  ///< of the odometry, if that is one
  linux::MonotonicClock clock;
  bool wait = false;

  [[nodiscard]] host::PortRequest port() const;
};

/// errors, of `open`: host::DeviceFailure
struct CameraDriver {
  Given<std::unique_ptr<host::CameraDevice> (*)(const Opening&)> open;
  /// Resolution, field of view and latency as the camera's maker says them; the mount is the robot's.
  Given<std::optional<sensor::CameraIntrinsics> (*)(const DeviceSpec&)> profile;
  /// Where the lens of that is from: "maker: ...", "published: ..." (by others) or "assumed: ...", and for whom.
  Given<std::string> lens;
};
struct OdometryDriver {
  Given<std::unique_ptr<host::OdometryDevice> (*)(const Opening&)> open;
  /// The brick that it is, which a camera may share; nothing for others.
  std::shared_ptr<host::SharedBrick> (*brick)(const DeviceSpec&, bool wait) = nullptr;
};

/// How `run` and `record` use it.
struct Live {
  std::vector<PlaceKind> places;
  std::vector<Option> options;
  Given<std::string> unready;  ///< why it may answer and not work, or the remedy
  std::variant<CameraDriver, OdometryDriver> driver;
};

/// How `emulate` plays it.
struct Emulated {
  Given<std::string> tells;  ///< the readings it sends, beyond the image's limits
  std::vector<Option> options;
  Given<emulate::Describe> describe;
  Given<std::unique_ptr<emulate::DeviceModel> (*)(const DeviceSpec&, const emulate::Colours&)> make;
  std::optional<emulate::ImageLimits> image = {};  ///< of cameras
  bool asked = false;                              ///< a camera that says something only when asked
  emulate::WheelShape wheels = {};                 ///< zeros: none that counts
  std::string label = {};                          ///< in messages, where that is not the row's name
  std::vector<PlaceKind> places = {PlaceKind::kTty, PlaceKind::kTcp};
};

struct UsbIds {
  std::uint16_t vendor = 0;
  std::uint16_t product = 0;
};

/// A peer that a device was tested with on a link, beside the tests of its decoder. Its name exists: a test looks for
/// it.
struct Tried {
  PlaceKind link = PlaceKind::kTty;  ///< kTty includes kTcp
  /// Where `emulate` does not reach: a test ("Suite.Name", or a hostile hour's "KIND:LINK") with an emulator there.
  std::string bench = {};
  std::string guest = {};   ///< "Suite.Name" of tests/guest: on a real kernel's bus
  std::string others = {};  ///< other people's programs at the emulator, or firmware at the driver; none: emulator only
};

struct Row {
  Given<std::string> name;   ///< KIND on the command line
  Given<std::string> about;  ///< the device as people call it
  Given<Role> role;
  Given<std::optional<Live>> live;
  Given<std::optional<Emulated>> emulated;
  /// Its names in `set camera` and `set odometry` on a board (firmware/config/devices.hpp).
  std::vector<std::string> images = {};
  /// Its own ids on USB; of one behind a serial adapter there are none.
  std::optional<UsbIds> usb = {};
  std::vector<Tried> tried = {};
};
using Rows = std::vector<Row>;

}  // namespace fencepost::devices
