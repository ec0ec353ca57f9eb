#include "host/live/run_log.hpp"

#include <fmt/format.h>

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
  return RunLog(std::move(calibration), std::move(*opened), settings.path);
}

RunLog::Fault RunLog::write(std::string_view line, base::Time now) {
  Fault fault = file_.write(line, now);
  calibration_->note(line);
  return fault;
}

std::string RunLog::name() const { return file_.parts() > 1 ? fmt::format("{} to {}", first_, file_.path()) : first_; }

}  // namespace fencepost::host
