// How a device is named on a command line: KIND[:PLACE][,option=value...].
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "hal/base/result.hpp"
#include "host/devices/row.hpp"

namespace fencepost::devices {

/// The use for which a device is named.
enum class Use : std::uint8_t {
  kCamera,    ///< `run --camera`: PLACE is where it is plugged in
  kOdometry,  ///< `run --odometry`
  /// `emulate`: PLACE is nothing or `pty`, a path (a link to the pty), `tcp:[HOST:]PORT`, of `can` the interface.
  kEmulated,
};

struct DeviceSpec {
  const Row* row = nullptr;
  Use use = Use::kCamera;
  std::string text;  ///< as written
  /// On TCP an emulated device's name is [HOST:]PORT; without a place it is kTty and has no name.
  host::Place place;
  std::map<std::string, std::string> options;  ///< checked: known to this device at this place, and possible

  /// "pixy2".
  [[nodiscard]] const std::string& kind_name() const { return *row->name; }
  /// "pixy2 at /dev/ttyUSB0"; of the console "console".
  [[nodiscard]] std::string where() const;
  /// As given, else as the row has it; the row knows the option.
  [[nodiscard]] std::string option(const std::string& name) const;
  [[nodiscard]] std::uint32_t number(const std::string& name) const;
  [[nodiscard]] double real(const std::string& name) const;
};

/// errors: a sentence that says what is wrong in `text` and what is allowed instead.
base::Result<DeviceSpec, std::string> parse_device(std::string_view text, Use use);

/// The options that a row has in a use.
const std::vector<Option>& options_of(const Row& row, Use use);
/// The places. The row has that use.
const std::vector<PlaceKind>& places_of(const Row& row, Use use);

}  // namespace fencepost::devices
