#include "host/cli/files.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "host/cli/exit_code.hpp"
#include "host/cli/interrupt.hpp"
#include "host/cli/terminal.hpp"
#include "host/text/gunzip.hpp"

namespace fencepost::host::cli {
namespace {

namespace fs = std::filesystem;

constexpr mode_t kNewFileMode = 0666;  ///< narrowed by the umask

std::string reason(int error) { return std::system_category().message(error); }

class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ > STDERR_FILENO) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  [[nodiscard]] int get() const { return fd_; }
  /// The error of closing, which is where some file systems first report a full disk; 0 when all is well.
  int close() {
    const int result = fd_ > STDERR_FILENO ? ::close(fd_) : 0;
    fd_ = -1;
    return result == 0 ? 0 : errno;
  }

 private:
  int fd_;
};

[[noreturn]] void fail_reading(const std::string& path, int error) {
  std::string remedy = "; check the path";
  if (error == EISDIR) remedy = "; name a file inside it";
  if (error == EACCES) remedy = "; you may need chmod u+r";
  throw Failure(Exit::kUnreadable, "cannot read " + input_name(path) + ": " + reason(error) + remedy);
}

[[noreturn]] void fail_writing(const std::string& path, int error) {
  std::string remedy = "; choose another place with -o";
  if (error == ENOSPC) remedy = "; free some space, or choose another place with -o";
  if (error == EBADF) remedy = "; it is closed: open it, or name a file with -o";
  if (error == EACCES || error == EROFS)
    remedy = "; you may not write there: change that, or choose another place with -o";
  if (error == ENOENT) remedy = "; create the folder first, or choose another place with -o";
  const std::string name = is_standard_output(path) ? "standard output" : path;
  throw Failure(Exit::kDevice, "cannot write " + name + ": " + reason(error) + remedy);
}

/// 0, or the error.
int write_all(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

/// The files that were read so far: a result must not replace them.
std::vector<struct stat>& inputs() {
  static std::vector<struct stat> files;
  return files;
}

void remember_input(int fd) {
  struct stat about {};
  if (::fstat(fd, &about) == 0 && S_ISREG(about.st_mode)) inputs().push_back(about);
}

void refuse_input(const std::string& path, const struct stat& output) {
  for (const struct stat& input : inputs()) {
    if (input.st_dev != output.st_dev || input.st_ino != output.st_ino) continue;
    throw Failure(Exit::kUsage, path + " is also the input, and would be replaced; choose another name with -o");
  }
}

/// "/dev/fd/7" is 7: opened by name, a file would be written from its start, over what was appended to it.
std::optional<int> named_descriptor(const std::string& path) {
  if (path == "-" || path == "/dev/stdout") return STDOUT_FILENO;
  if (path == "/dev/stderr") return STDERR_FILENO;
  for (const std::string_view folder : {"/dev/fd/", "/proc/self/fd/"}) {
    if (!path.starts_with(folder)) continue;
    int number = -1;
    const char* end = path.data() + path.size();
    const auto [stopped, error] = std::from_chars(path.data() + folder.size(), end, number);
    if (error == std::errc() && stopped == end && number >= 0) return number;
  }
  return std::nullopt;
}

void write_directly(const std::string& path, std::string_view bytes) {
  Descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
  if (file.get() < 0) fail_writing(path, errno);
  if (const int error = write_all(file.get(), bytes)) fail_writing(path, error);
  if (const int error = file.close()) fail_writing(path, error);
}

/// What a link, or a link to a link, leads to, whether or not that is there yet.
fs::path followed(fs::path path) {
  constexpr int kMostLinks = 40;  // as many as the kernel follows
  std::error_code no_link;
  for (int i = 0; i < kMostLinks; ++i) {
    const fs::path next = fs::read_symlink(path, no_link);
    if (no_link) break;
    path = path.parent_path() / next;  // an absolute one replaces it
  }
  return path;
}

// Short, since the name itself may be as long as names can be.
fs::path temporary_beside(const fs::path& target) {
  return target.parent_path() / (".fencepost" + std::to_string(::getpid()) + ".part");
}

/// 0, or the error. What cannot be brought to a disk, such as a file in memory, need not be.
int sync_all(int fd) {
  if (::fsync(fd) == 0 || errno == EINVAL || errno == ENOSYS || errno == EROFS) return 0;
  return errno;
}

void write_and_rename(const std::string& path, std::string_view bytes) {
  const fs::path target = followed(path);
  const std::string temporary = temporary_beside(target).string();
  struct stat old {};
  const bool replaces = ::stat(target.c_str(), &old) == 0;
  if (replaces) refuse_input(path, old);
  if (replaces && ::access(target.c_str(), W_OK) != 0) fail_writing(path, errno);

  const RemoveOnInterrupt guard(temporary);
  Descriptor file(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kNewFileMode));
  if (file.get() < 0) fail_writing(path, errno);
  int error = write_all(file.get(), bytes);
  if (error == 0 && replaces && ::fchmod(file.get(), old.st_mode & 07777) != 0) error = errno;
  if (error == 0) error = sync_all(file.get());
  if (const int closing = file.close(); error == 0) error = closing;
  if (error == 0 && ::rename(temporary.c_str(), target.c_str()) != 0) error = errno;
  if (error != 0) {
    ::unlink(temporary.c_str());
    fail_writing(path, error);
  }
}

}  // namespace

std::string input_name(const std::string& path) { return path == "-" ? "standard input" : path; }

namespace {

std::string unpacked(std::string bytes, const std::string& path) {
  if (!is_gzip(bytes)) return bytes;
  if (std::optional<std::string> whole = gunzip(bytes)) return std::move(*whole);
  throw Failure(Exit::kUnreadable,
                "cannot read " + input_name(path) +
                    ": what gzip packed is damaged or cut off; try 'gzip -t' on it, and copy it again");
}

}  // namespace

std::string read_input(const std::string& path) {
  const bool standard = path == "-";
  if (standard && is_terminal(STDIN_FILENO)) say("reading from the terminal; end with Ctrl-D");
  const Descriptor file(standard ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0) fail_reading(path, errno);
  remember_input(file.get());
  std::string bytes;
  std::array<char, 1 << 16> chunk;
  while (true) {
    const ssize_t size = ::read(file.get(), chunk.data(), chunk.size());
    if (size < 0 && errno == EINTR) continue;
    if (size < 0) fail_reading(path, errno);
    if (size == 0) return unpacked(std::move(bytes), path);
    bytes.append(chunk.data(), static_cast<std::size_t>(size));
  }
}

bool is_standard_output(const std::string& path) { return named_descriptor(path) == STDOUT_FILENO; }

void write_output(const std::string& path, std::string_view bytes) {
  if (const std::optional<int> fd = named_descriptor(path)) {
    const int error = write_all(*fd, bytes);
    if (error != 0 && error != EPIPE) fail_writing(path, error);
    return;
  }
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (fs::is_directory(status)) fail_writing(path, EISDIR);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    write_directly(path, bytes);
  } else {
    write_and_rename(path, bytes);
  }
}

}  // namespace fencepost::host::cli
