#include "host/cli/spool.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>

#include "host/cli/exit_code.hpp"

namespace fencepost::host::cli {
namespace {

std::string temporary_folder() {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  return error ? "/tmp" : folder.string();
}

[[noreturn]] void fail_spooling(int error) {
  throw Failure(Exit::kDevice, "cannot put a long result aside in " + temporary_folder() + ": " +
                                   std::generic_category().message(error) +
                                   "; free some space there, or name another folder with TMPDIR");
}

int open_nameless() {
  const std::string folder = temporary_folder();
  const int file = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (file >= 0) return file;
  std::string name = folder + "/fencepost-XXXXXX";  // a file system without nameless files
  const int named = ::mkostemp(name.data(), O_CLOEXEC);
  if (named < 0) fail_spooling(errno);
  ::unlink(name.c_str());
  return named;
}

}  // namespace

Spool::~Spool() {
  if (file_ >= 0) ::close(file_);
}

void Spool::append(std::string_view bytes) {
  memory_ += bytes;
  if (memory_.size() >= kInMemory) move_to_file();
}

void Spool::clear() {
  memory_.clear();
  filed_ = 0;
}

void Spool::move_to_file() {
  if (file_ < 0) file_ = open_nameless();
  std::string_view left = memory_;
  while (!left.empty()) {
    const ssize_t written = ::pwrite(file_, left.data(), left.size(), static_cast<off_t>(filed_));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail_spooling(errno);
    filed_ += static_cast<std::uint64_t>(written);
    left.remove_prefix(static_cast<std::size_t>(written));
  }
  memory_.clear();
}

void Spool::read(const std::function<void(std::string_view)>& portion) const {
  std::string part;
  for (std::uint64_t at = 0; at < filed_; at += part.size()) {
    part.resize(std::min<std::uint64_t>(kInMemory, filed_ - at));
    for (std::size_t have = 0; have < part.size();) {
      const ssize_t got = ::pread(file_, part.data() + have, part.size() - have, static_cast<off_t>(at + have));
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) fail_spooling(got < 0 ? errno : EIO);
      have += static_cast<std::size_t>(got);
    }
    portion(part);
  }
  if (!memory_.empty()) portion(memory_);
}

}  // namespace fencepost::host::cli
