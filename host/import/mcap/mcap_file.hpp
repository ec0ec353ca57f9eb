// Messages of an MCAP file (mcap.dev, specification 0x0): channels, schemas, chunks without compression, lz4 or zstd.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace fencepost::host {

struct McapMessage {
  std::string_view topic;
  std::string_view schema;    ///< its name, such as vision_msgs/msg/Detection2DArray
  std::string_view encoding;  ///< "cdr", "json", ...
  double log_time = 0;        ///< s
  std::string_view data;
};

/// In order of the file. A file that was cut off is read as far as it goes; `truncated` says that.
/// errors: ImportProblem: no MCAP, or a compression that is not known
struct McapEnd {
  bool truncated = false;
};
McapEnd read_mcap(std::string_view bytes, const std::string& file, const std::function<void(const McapMessage&)>& take);

}  // namespace fencepost::host
