// When a cable's state is worth a word, and which.
#pragma once

#include <optional>
#include <string>

#include "firmware/record/records.hpp"
#include "host/live/device_spec.hpp"

namespace fencepost::host {

/// What is told of a link, once: the record of the stream and a sentence for people.
struct LinkNews {
  record::LinkReport report;
  std::string sentence;
};

/// Gone and back are told at once; other states when they have lasted a second, since a device that starts, or a blob
/// that flickers, goes through several.
class LinkWatch {
 public:
  /// Device and detail of the records: the kind, and where it is.
  LinkWatch(DeviceRole role, const DeviceSpec& spec);

  /// `problem`: what the port says of its absence; may be empty.
  std::optional<LinkNews> observe(sensor::LinkState state, const std::string& problem, base::Time now);

 private:
  [[nodiscard]] std::string sentence(sensor::LinkState state, const std::string& problem) const;

  std::string name_;  ///< "camera pixy2 at /dev/ttyUSB0"
  DeviceSpec spec_;
  std::optional<sensor::LinkState> told_;
  std::optional<sensor::LinkState> seen_;
  base::Time since_;
};

}  // namespace fencepost::host
