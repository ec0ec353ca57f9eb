#include "host/live/log_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <filesystem>
#include <thread>
#include <utility>

namespace fencepost::host {
namespace {

namespace fs = std::filesystem;
using linux::Descriptor;
using linux::failure;

constexpr mode_t kNewFileMode = 0666;  ///< narrowed by the umask

std::string_view remedy(int error) {
  switch (error) {
    case EEXIST: return "choose another name, or move it away; a log is never overwritten";
    case ENOENT: return "create the folder first";
    case EISDIR: return "name a file inside it";
    case EACCES:
    case EPERM:
    case EROFS: return "choose a place where you may write";
    case ENOSPC:
    case EDQUOT: return "free some space, or choose another disk; what was written before is kept";
    case EFBIG: return "raise 'ulimit -f', or write smaller parts; what was written before is kept";
    case EPIPE: return "its reader has gone; start it again";
    case ENXIO: return "nobody reads this pipe; start its reader first";
    case EWOULDBLOCK: return "another run writes it; choose another name";
    default: return "look at the end of 'dmesg', or choose another disk; what was written before is kept";
  }
}

// Neither a file that could be overwritten nor one that could be created: /dev/full, a named pipe.
bool is_device(const std::string& path) {
  struct stat about {};
  return ::stat(path.c_str(), &about) == 0 && !S_ISREG(about.st_mode) && !S_ISDIR(about.st_mode);
}

int create_flags(const LogFileSettings& settings, const std::string& path) {
  if (is_device(path)) return 0;
  return O_CREAT | (settings.overwrite ? 0 : O_EXCL);
}

/// Opened for appending; a pipe's reader is waited for two seconds. The file is this run's alone, and emptied only
/// then. errors: errno
Descriptor open_log(const std::string& path, const LogFileSettings& settings) {
  constexpr int kFlags = O_WRONLY | O_APPEND | O_CLOEXEC | O_NONBLOCK;
  constexpr int kLooks = 100;
  const auto open = [&] { return ::open(path.c_str(), kFlags | create_flags(settings, path), kNewFileMode); };
  Descriptor fd(open());
  for (int look = 0; look < kLooks && !fd.open() && errno == ENXIO; ++look) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    fd = Descriptor(open());
  }
  struct stat about {};
  if (!fd.open() || ::fstat(fd.get(), &about) != 0) return {};
  ::fcntl(fd.get(), F_SETFL, O_APPEND);  // from here on a full pipe is waited for
  if (!S_ISREG(about.st_mode)) return fd;
  // Where a file system has no locks, there is none.
  const bool taken = ::flock(fd.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  if (taken || (about.st_size > 0 && ::ftruncate(fd.get(), 0) != 0)) {
    const int error = errno;
    fd.close();
    errno = error;
  }
  return fd;
}

// A new name is on the disk only when its folder is.
Descriptor folder_of(const std::string& path) {
  const std::string folder = fs::path(path).parent_path().string();
  return Descriptor(::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
}

}  // namespace

std::string part_path(const std::string& path, unsigned number) {
  if (number <= 1) return path;
  const fs::path whole(path);
  const std::string name = fmt::format("{}-{:04}{}", whole.stem().string(), number, whole.extension().string());
  return (whole.parent_path() / name).string();
}

linux::Opened<LogFile> LogFile::open(LogFileSettings settings, base::Time now) {
  LogFile log(std::move(settings));
  log.last_sync_ = now;
  if (Fault fault = log.start_part(1, now)) return std::move(*fault);
  return log;
}

LogFile::~LogFile() {
  // Moved from: nothing to close.
  if (syncing_ && close()) return;
}

LogFile::Fault LogFile::start_part(unsigned number, base::Time now) {
  const std::string path = part_path(settings_.path, number);
  Descriptor fd = open_log(path, settings_);
  if (!fd.open()) return failure("create the log", path, errno, remedy(errno));
  if (Descriptor folder = folder_of(path); folder.open()) syncing_->sync(std::move(folder));
  if (fd_.open()) syncing_->sync(std::move(fd_));
  fd_ = std::move(fd);
  path_ = path;
  number_ = number;
  ++parts_;
  bytes_of_part_ = 0;
  part_start_ = now;
  return std::nullopt;
}

// Later names may be taken by an earlier run, whose first part was moved away: stopping there would lose this run.
LogFile::Fault LogFile::start_next_part(base::Time now) {
  unsigned number = number_ + 1;
  std::error_code unknown;  // opening the part says what is wrong with its name
  while (!settings_.overwrite && fs::exists(fs::symlink_status(part_path(settings_.path, number), unknown))) ++number;
  if (Fault fault = start_part(number, now)) return fault_ = std::move(fault);
  return settings_.part_start ? put(settings_.part_start()) : std::nullopt;
}

bool LogFile::aged(base::Time now) const {
  return settings_.part_age > base::Duration{} && now - part_start_ >= settings_.part_age;
}

bool LogFile::part_is_over(base::Time now) const {
  if (!at_line_start_ || bytes_of_part_ == 0) return false;
  return aged(now) || (settings_.part_bytes > 0 && bytes_of_part_ >= settings_.part_bytes);
}

// How many of the bytes still belong to this part: up to the first line end that ends it, if there is one.
std::size_t LogFile::share_of_part(std::string_view bytes, base::Time now) const {
  if (settings_.part_bytes == 0 && !aged(now)) return bytes.size();
  std::uint64_t last = 0;
  if (!aged(now) && settings_.part_bytes > bytes_of_part_) last = settings_.part_bytes - bytes_of_part_ - 1;
  if (last >= bytes.size()) return bytes.size();
  const std::size_t end = bytes.find('\n', static_cast<std::size_t>(last));
  return end == std::string_view::npos ? bytes.size() : end + 1;
}

LogFile::Fault LogFile::write(std::string_view bytes, base::Time now) {
  while (!bytes.empty() && fd_.open() && !fault_) {
    if (part_is_over(now) && start_next_part(now)) break;
    const std::string_view share = bytes.substr(0, share_of_part(bytes, now));
    if (put(share)) break;
    bytes.remove_prefix(share.size());
  }
  return fault_;
}

LogFile::Fault LogFile::put(std::string_view bytes) {
  while (!bytes.empty() && fd_.open()) {
    const ssize_t written = ::write(fd_.get(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return fail(errno);
    const auto count = static_cast<std::size_t>(written);
    unsynced_ = true;
    bytes_ += count;
    bytes_of_part_ += count;
    at_line_start_ = bytes[count - 1] == '\n';
    bytes.remove_prefix(count);
  }
  return std::nullopt;
}

LogFile::Fault LogFile::fail(int error) {
  fault_ = failure("write the log", path_, error, remedy(error));
  return fault_;
}

LogFile::Fault LogFile::tend(base::Time now) {
  if (const int error = syncing_->error(); error != 0 && !fault_) return fail(error);
  if (fault_ || !fd_.open() || !unsynced_ || syncing_->busy() || now - last_sync_ < kSyncInterval) return fault_;
  Descriptor same(::fcntl(fd_.get(), F_DUPFD_CLOEXEC, 0));
  if (!same.open()) return fail(errno);
  syncing_->sync(std::move(same));
  last_sync_ = now;
  unsynced_ = false;
  return std::nullopt;
}

LogFile::Fault LogFile::close() {
  if (!fd_.open()) return fault_;
  syncing_->sync(std::move(fd_));
  const int error = syncing_->drain();
  if (error != 0 && !fault_) return fail(error);
  return fault_;
}

}  // namespace fencepost::host
