#include "host/live/run_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace fencepost::host {

linux::Opened<RunLog> RunLog::open(const RunLogSettings& settings, base::Time now) {
  std::error_code ignored;
  if (!settings.overwrite && std::filesystem::is_regular_file(settings.path, ignored)) {
    return linux::Problem{"cannot create the log " + settings.path +
                          ": there is one; choose another name, move it away, or add --force to overwrite it"};
  }
  auto calibration = std::make_unique<CalibrationLines>();
  LogFileSettings file;
  file.path = settings.path;
  file.overwrite = settings.overwrite;
  file.part_bytes = settings.part_bytes;
  file.part_age = settings.part_age;
  file.part_start = [lines = calibration.get(), first = settings.path, profile = settings.profile] {
    return fmt::format("# the run goes on that began in {}, profile {}\r\n", first, profile) + lines->in_force();
  };
  linux::Opened<LogFile> opened = LogFile::open(std::move(file), now);
  if (!opened) return linux::Problem{opened.problem()};
  const bool parts = settings.part_bytes > 0 || settings.part_age > base::Duration{};
  return RunLog(std::move(calibration), std::move(*opened), settings.path, parts);
}

// In portions as large as possible: some disks take more than a second for each. Where there are parts, a line of the
// calibration ends one. So a part that begins within a portion begins with the calibration in force there.
RunLog::Fault RunLog::write(std::string_view lines, base::Time now) {
  std::size_t end = 0;
  while (parts_ && end < lines.size()) {
    const std::size_t begin = end;
    end = std::min(lines.find('\n', begin), lines.size() - 1) + 1;
    const std::string_view line = lines.substr(begin, end - begin);
    if (!CalibrationLines::is_one(line)) continue;
    if (Fault fault = file_.write(lines.substr(0, end), now)) return fault;
    calibration_->note(line);
    lines.remove_prefix(end);
    end = 0;
  }
  return file_.write(lines, now);
}

std::string RunLog::name() const { return file_.parts() > 1 ? fmt::format("{} to {}", first_, file_.path()) : first_; }

}  // namespace fencepost::host
