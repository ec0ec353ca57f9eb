// Device specifications on a command line: KIND[:PLACE][,option=value...].
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fencepost::host {

struct DeviceOption {
  std::string name;
  std::string value;
};

/// The parts as written; whether they are valid is not checked here.
struct DeviceWord {
  std::string kind;
  std::optional<std::string> place;  ///< text behind the first colon
  std::vector<DeviceOption> options;
  /// A clause, if an option is no NAME=VALUE or is given twice. To be reported once kind and place are known to be
  /// valid.
  std::string problem;
};

DeviceWord split_device(std::string_view text);

/// Decimal, or hexadecimal behind 0x; nothing else.
std::optional<std::uint32_t> whole_number(std::string_view text);

/// "a, b, c".
std::string listed(const std::vector<std::string>& words);

/// `there is no camera "pixi2"; did you mean pixy2? allowed: pixy, pixy2`
std::string no_such(std::string_view what, std::string_view word, const std::vector<std::string>& known);

}  // namespace fencepost::host
