// A log on disk: what was written survives a kill at once, and a power cut after a second.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "hal/base/units.hpp"
#include "hal/linux/descriptor.hpp"
#include "hal/linux/opened.hpp"
#include "host/live/sync_thread.hpp"

namespace fencepost::host {

struct LogFileSettings {
  std::string path;        ///< the first part; an existing device or pipe is written as it is
  bool overwrite = false;  ///< else a file that exists is never touched
  /// A part ends with the first line that makes it this long, or that comes when it is this old. 0: never.
  std::uint64_t part_bytes = 0;
  base::Duration part_age{};
  /// First lines of each later part, such as the records that say how to read the others; may be empty.
  std::function<std::string()> part_start{};
};

/// The path of a part, from 1: run.log, run-0002.log, run-0003.log. Parts are never renamed; in order of their
/// numbers they are the bytes that were written, with `part_start` between them.
std::string part_path(const std::string& path, unsigned number);

/// Each write is in the kernel when it returns, and on the disk within about a second as long as `tend` is called.
/// After the first error every call answers the same one; what was written before it stays.
class LogFile {
 public:
  using Fault = std::optional<linux::Problem>;

  /// errors: a sentence: exists already, no such folder, not allowed, disk full.
  static linux::Opened<LogFile> open(LogFileSettings settings, base::Time now);
  /// Closes without reporting errors; `close` reports them.
  ~LogFile();
  LogFile(LogFile&&) noexcept = default;
  LogFile& operator=(LogFile&&) = delete;
  LogFile(const LogFile&) = delete;
  LogFile& operator=(const LogFile&) = delete;

  /// Bytes in any portions, not only lines; a part ends at a line's end only.
  /// errors: a sentence: disk full, file too large, device gone. Some of the bytes may have been written.
  [[nodiscard]] Fault write(std::string_view bytes, base::Time now);
  /// Once per loop iteration: starts bringing what was written to the disk, at most once in kSyncInterval.
  /// errors: those that the disk reports only then.
  [[nodiscard]] Fault tend(base::Time now);
  /// All on the disk, and closed. Later calls do nothing.
  [[nodiscard]] Fault close();

  static constexpr base::Duration kSyncInterval = base::milliseconds(1000);

  /// The part being written.
  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] unsigned parts() const { return parts_; }
  /// Bytes of all parts.
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

 private:
  explicit LogFile(LogFileSettings settings) : settings_(std::move(settings)) {}
  [[nodiscard]] Fault start_part(unsigned number, base::Time now);
  [[nodiscard]] Fault start_next_part(base::Time now);
  [[nodiscard]] bool part_is_over(base::Time now) const;
  [[nodiscard]] bool aged(base::Time now) const;
  [[nodiscard]] std::size_t share_of_part(std::string_view bytes, base::Time now) const;
  [[nodiscard]] Fault put(std::string_view bytes);
  Fault fail(int error);

  LogFileSettings settings_;
  std::string path_;
  linux::Descriptor fd_;
  std::unique_ptr<SyncThread> syncing_ = std::make_unique<SyncThread>();
  unsigned parts_ = 0;
  unsigned number_ = 0;  ///< of the part; may be more than parts_ where other files were in the way
  std::uint64_t bytes_ = 0;
  std::uint64_t bytes_of_part_ = 0;
  base::Time part_start_{};
  base::Time last_sync_{};
  bool at_line_start_ = true;
  bool unsynced_ = false;
  Fault fault_;
};

}  // namespace fencepost::host
