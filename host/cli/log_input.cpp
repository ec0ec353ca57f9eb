#include "host/cli/log_input.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

#include "host/cli/exit_code.hpp"
#include "host/cli/files.hpp"
#include "host/cli/terminal.hpp"

namespace fencepost::host::cli {
namespace {

constexpr std::size_t kChunk = 1U << 16U;

[[noreturn]] void fail_reading(const std::string& path, int error) {
  std::string remedy = "; check the path";
  if (error == EISDIR) remedy = "; name a file inside it";
  if (error == EACCES) remedy = "; you may need chmod u+r";
  throw Failure(Exit::kUnreadable,
                "cannot read " + input_name(path) + ": " + std::generic_category().message(error) + remedy);
}

}  // namespace

LogInput::LogInput(std::string path) : path_(std::move(path)), chunk_(kChunk, '\0') {
  const bool standard = path_ == "-";
  if (standard && is_terminal(STDIN_FILENO)) say("reading from the terminal; end with Ctrl-D");
  file_ = standard ? STDIN_FILENO : ::open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  if (file_ < 0) fail_reading(path_, errno);
  remember_input(file_);
  struct stat about {};
  if (::fstat(file_, &about) == 0 && S_ISREG(about.st_mode)) size_ = static_cast<std::uint64_t>(about.st_size);
}

LogInput::~LogInput() {
  if (file_ > STDERR_FILENO) ::close(file_);
}

std::string_view LogInput::read() {
  std::size_t size = 0;
  // At the beginning at least two bytes: they show whether it is gzip or UTF-16.
  while (size == 0 || (!begun_ && size < 2)) {
    const ssize_t got = ::read(file_, chunk_.data() + size, chunk_.size() - size);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail_reading(path_, errno);
    if (got == 0) break;
    size += static_cast<std::size_t>(got);
  }
  position_ += size;
  return {chunk_.data(), size};
}

std::string_view LogInput::next() {
  const bool first = position_ == 0;
  const std::string_view bytes = unpacked();
  const bool utf16 = first && (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF"));
  if (!utf16) return bytes;
  throw Failure(Exit::kUnreadable, "cannot read " + input_name(path_) +
                                       ": it is UTF-16, as PowerShell's > writes text; 'iconv -f UTF-16 -t UTF-8' "
                                       "makes text of it that can be read");
}

std::string_view LogInput::unpacked() {
  if (!begun_) {
    const std::string_view first = read();
    begun_ = true;
    if (!is_gzip(first)) return first;
    gunzip_ = std::make_unique<Gunzip>();
    gunzip_->feed(first);
  }
  if (!gunzip_) return read();
  while (true) {
    const std::string_view unpacked = gunzip_->next();
    if (!unpacked.empty()) return unpacked;
    const std::string_view more = gunzip_->damaged() ? std::string_view() : read();
    if (more.empty() && !gunzip_->damaged() && gunzip_->complete()) return {};
    if (more.empty()) {
      throw Failure(Exit::kUnreadable,
                    "cannot read " + input_name(path_) +
                        ": what gzip packed is damaged or cut off; try 'gzip -t' on it, and copy it again");
    }
    gunzip_->feed(more);
  }
}

std::string how_to_make_a_part(const std::string& path) {
  return "make a part of it: fencepost replay " + (path == "-" ? "LOG" : path) +
         " --from 0 --to 600 --write-log part.log";
}

void refuse_long_log(const std::string& path) {
  throw Failure(Exit::kUnreadable, input_name(path) + " has more than " + std::to_string(kMaxWhole / 1'000'000) +
                                       " MB, too much to look at all of it at once; " + how_to_make_a_part(path));
}

std::string read_log(const std::string& path) {
  constexpr std::size_t kLine = 2048;  // twice as long as a record may be
  LogInput input(path);
  std::string log;
  std::size_t line = 0;  // its length in there
  for (std::string_view part = input.next(); !part.empty(); part = input.next()) {
    while (!part.empty()) {
      const std::size_t end = std::min(part.find('\n'), part.size());
      const std::string_view kept = part.substr(0, std::min(end, kLine - line));
      log += kept;
      line += kept.size();
      if (end < part.size()) {
        log += '\n';
        line = 0;
      }
      part.remove_prefix(std::min(end + 1, part.size()));
    }
    if (log.size() > kMaxWhole) refuse_long_log(path);
  }
  return log;
}

void expect_whole_log(const std::string& path) {
  std::error_code none;
  if (path == "-" || !std::filesystem::is_regular_file(path, none)) return;
  LogInput input(path);
  std::size_t size = 0;
  while (size <= kMaxWhole) {
    const std::string_view part = input.next();
    if (part.empty()) return;
    size += part.size();
  }
  refuse_long_log(path);
}

std::string read_log_or_scene(const std::string& path) {
  LogInput input(path);
  std::string all;
  for (std::string_view part = input.next(); !part.empty(); part = input.next()) {
    all += part;
    if (all.size() > kMaxWhole) refuse_long_log(path);
  }
  return all;
}

}  // namespace fencepost::host::cli
