#include "host/cli/files.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <filesystem>
#include <system_error>

#include "host/cli/exit_code.hpp"
#include "host/cli/interrupt.hpp"
#include "host/cli/terminal.hpp"

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
  /// The error of closing, which is where some file systems first tell of a full disk; 0 when all is well.
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
  if (error == ENOENT) remedy = "; create the folder first, or choose another place with -o";
  const std::string name = path == "-" ? "standard output" : path;
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

void write_directly(const std::string& path, std::string_view bytes) {
  Descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
  if (file.get() < 0) fail_writing(path, errno);
  if (const int error = write_all(file.get(), bytes)) fail_writing(path, error);
  if (const int error = file.close()) fail_writing(path, error);
}

void write_and_rename(const std::string& path, std::string_view bytes) {
  std::error_code ignored;
  // A link stays a link: what it points to is replaced.
  const fs::path target = fs::is_symlink(path, ignored) ? fs::weakly_canonical(path, ignored) : fs::path(path);
  const std::string temporary = target.string() + ".part" + std::to_string(::getpid());
  struct stat old {};
  const bool replaces = ::stat(target.c_str(), &old) == 0;

  Descriptor file(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kNewFileMode));
  if (file.get() < 0) fail_writing(path, errno);
  const RemoveOnInterrupt guard(temporary);
  int error = write_all(file.get(), bytes);
  if (error == 0 && replaces && ::fchmod(file.get(), old.st_mode & 07777) != 0) error = errno;
  if (const int closing = file.close(); error == 0) error = closing;
  if (error == 0 && ::rename(temporary.c_str(), target.c_str()) != 0) error = errno;
  if (error != 0) {
    ::unlink(temporary.c_str());
    fail_writing(path, error);
  }
}

}  // namespace

std::string input_name(const std::string& path) { return path == "-" ? "standard input" : path; }

std::string read_input(const std::string& path) {
  const bool standard = path == "-";
  if (standard && is_terminal(STDIN_FILENO)) say("reading from the terminal; end with Ctrl-D");
  const Descriptor file(standard ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0) fail_reading(path, errno);
  std::string bytes;
  std::array<char, 1 << 16> chunk;
  while (true) {
    const ssize_t size = ::read(file.get(), chunk.data(), chunk.size());
    if (size < 0 && errno == EINTR) continue;
    if (size < 0) fail_reading(path, errno);
    if (size == 0) return bytes;
    bytes.append(chunk.data(), static_cast<std::size_t>(size));
  }
}

void write_output(const std::string& path, std::string_view bytes) {
  if (path == "-") {
    const int error = write_all(STDOUT_FILENO, bytes);
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
