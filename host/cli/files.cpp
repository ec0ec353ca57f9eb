#include "host/cli/files.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "host/cli/exit_code.hpp"
#include "host/cli/interrupt.hpp"
#include "host/cli/log_input.hpp"
#include "host/cli/spool.hpp"
#include "host/cli/system.hpp"

namespace fencepost::host::cli {

class OpenFile {
 public:
  explicit OpenFile(int fd) : fd_(fd) {}
  ~OpenFile() {
    if (fd_ > STDERR_FILENO) ::close(fd_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
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

namespace {

namespace fs = std::filesystem;

constexpr mode_t kNewFileMode = 0666;  ///< narrowed by the umask

std::string reason(int error) { return std::generic_category().message(error); }

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

/// The files that were read so far: a result must not replace them. Several threads read.
struct Inputs {
  std::mutex mutex;
  std::vector<FileId> files;
};
Inputs& inputs() {
  static Inputs all;
  return all;
}

void refuse_input(const std::string& path, const fs::path& target) {
  const OpenFile file(::open(target.string().c_str(), O_RDONLY | O_CLOEXEC));
  const std::optional<FileId> output = id_of_file(file.get());
  const std::lock_guard lock(inputs().mutex);
  if (!output || std::ranges::find(inputs().files, *output) == inputs().files.end()) return;
  throw Failure(Exit::kUsage, path + " is also the input, and would be replaced; choose another name with -o");
}

/// "/dev/fd/7" is 7. Opened by name, the file would be written from its start, over bytes that were appended.
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

/// The target of a link, or of a link to a link, even if it does not exist yet.
fs::path followed(fs::path path) {
  constexpr int kMaxLinks = 40;  // as many as the kernel follows
  std::error_code no_link;
  for (int i = 0; i < kMaxLinks; ++i) {
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

/// 0, or the error. A file that cannot be brought to a disk, such as one in memory, need not be.
int sync_all(int fd) {
  if (::fsync(fd) == 0 || errno == EINVAL || errno == ENOSYS || errno == EROFS) return 0;
  return errno;
}

/// 0, or the error. Replaces a file of that name.
int renamed(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::rename(from, to, error);
  return error.default_error_condition().value();
}

}  // namespace

std::string input_name(const std::string& path) { return path == "-" ? "standard input" : path; }

void remember_input(int descriptor) {
  const std::optional<FileId> input = id_of_file(descriptor);
  const std::lock_guard lock(inputs().mutex);
  if (input) inputs().files.push_back(*input);
}

std::string read_input(const std::string& path, std::size_t most) {
  LogInput input(path);
  std::string bytes;
  const auto check = [&](std::uint64_t size, std::size_t limit) {
    if (size <= limit) return;
    throw Failure(Exit::kUnreadable, input_name(path) + " has more than " + std::to_string(limit / 1'000'000) + " MB" +
                                         (input.packed() ? " when it is unpacked" : "") +
                                         "; leave out what is not needed");
  };
  check(input.size().value_or(0), most);
  for (std::string_view part = input.next(); !part.empty(); part = input.next()) {
    bytes += part;
    check(bytes.size(), input.packed() ? kMaxWhole : most);
  }
  return bytes;
}

bool is_standard_output(const std::string& path) { return named_descriptor(path) == STDOUT_FILENO; }

class OutputFile::Kind {
 public:
  virtual ~Kind() = default;
  virtual void write(std::string_view bytes) = 0;
  virtual void finish() = 0;
};

/// Standard output, or another that is open.
class OutputFile::Descriptor final : public Kind {
 public:
  Descriptor(std::string path, int descriptor) : path_(std::move(path)), descriptor_(descriptor) {}
  void write(std::string_view bytes) override { spool_.append(bytes); }
  void finish() override {
    spool_.read([this](std::string_view bytes) {
      const int error = stopped_ ? 0 : write_all(descriptor_, bytes);
      if (error != 0 && error != EPIPE) fail_writing(path_, error);
      stopped_ = stopped_ || error == EPIPE;
    });
  }

 private:
  std::string path_;
  int descriptor_;
  bool stopped_ = false;  ///< nobody reads it any more
  Spool spool_;
};

/// A pipe, /dev/null.
class OutputFile::Device final : public Kind {
 public:
  explicit Device(std::string path) : path_(std::move(path)) {}
  void write(std::string_view bytes) override { spool_.append(bytes); }
  void finish() override {
    OpenFile file(::open(path_.c_str(), O_WRONLY | O_CLOEXEC));
    if (file.get() < 0) fail_writing(path_, errno);
    spool_.read([&](std::string_view bytes) {
      if (const int error = write_all(file.get(), bytes)) fail_writing(path_, error);
    });
    if (const int error = file.close()) fail_writing(path_, error);
  }

 private:
  std::string path_;
  Spool spool_;
};

/// A file, written beside the old one.
class OutputFile::Replaced final : public Kind {
 public:
  explicit Replaced(std::string path)
      : path_(std::move(path)), target_(followed(path_)), temporary_(temporary_beside(target_).string()) {
    replaces_ = ::stat(target_.string().c_str(), &old_) == 0;
    if (replaces_) refuse_input(path_, target_);
    if (replaces_ && ::access(target_.string().c_str(), W_OK) != 0) fail_writing(path_, errno);
    guard_.emplace(temporary_);
    file_.emplace(::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kNewFileMode));
    if (file_->get() < 0) fail_writing(path_, errno);
    unfinished_ = true;
  }
  ~Replaced() override {
    file_.reset();
    if (unfinished_) ::unlink(temporary_.c_str());
  }
  Replaced(const Replaced&) = delete;
  Replaced& operator=(const Replaced&) = delete;

  void write(std::string_view bytes) override {
    constexpr std::size_t kPortion = 1U << 16U;
    buffer_ += bytes;
    if (buffer_.size() >= kPortion) flush();
  }
  void finish() override {
    flush();
    int error = replaces_ && ::fchmod(file_->get(), old_.st_mode & 07777) != 0 ? errno : 0;
    if (error == 0) error = sync_all(file_->get());
    if (const int closing = file_->close(); error == 0) error = closing;
    if (error == 0) error = renamed(temporary_, target_);
    if (error != 0) fail_writing(path_, error);
    unfinished_ = false;
  }

 private:
  void flush() {
    if (const int error = write_all(file_->get(), buffer_)) fail_writing(path_, error);
    buffer_.clear();
  }

  std::string path_;
  fs::path target_;
  std::string temporary_;
  struct stat old_ {};
  bool replaces_ = false;
  bool unfinished_ = false;
  std::optional<RemoveOnInterrupt> guard_;
  std::optional<OpenFile> file_;
  std::string buffer_;
};

OutputFile::OutputFile(std::string path) {
  if (const std::optional<int> descriptor = named_descriptor(path)) {
    kind_ = std::make_unique<Descriptor>(std::move(path), *descriptor);
    return;
  }
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (fs::is_directory(status)) fail_writing(path, EISDIR);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    kind_ = std::make_unique<Device>(std::move(path));
  } else {
    kind_ = std::make_unique<Replaced>(std::move(path));
  }
}

OutputFile::~OutputFile() = default;
void OutputFile::write(std::string_view bytes) { kind_->write(bytes); }
void OutputFile::finish() { kind_->finish(); }

void write_output(const std::string& path, std::string_view bytes) {
  if (const std::optional<int> descriptor = named_descriptor(path)) {
    const int error = write_all(*descriptor, bytes);
    if (error != 0 && error != EPIPE) fail_writing(path, error);
    return;
  }
  OutputFile file(path);
  file.write(bytes);
  file.finish();
}

}  // namespace fencepost::host::cli
