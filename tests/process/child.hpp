// A program that runs beside the test.
#pragma once

#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace fencepost::test {

/// The folder in which it runs, and its standard input, output and errors; negative: the test's own.
struct Surroundings {
  std::string folder = ".";
  int in = -1;
  int out = -1;
  int err = -1;
};

class Child {
 public:
  /// `program`: a path, or a name to be looked for; `words` begin with the name by which it is called. It inherits the
  /// test's open descriptors but for those with O_CLOEXEC. Throws std::runtime_error.
  Child(const std::string& program, std::vector<std::string> words, const Surroundings& at = {}) {
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t first;
    ::posix_spawn_file_actions_init(&first);
    ::posix_spawn_file_actions_addchdir_np(&first, at.folder.c_str());
    const std::array<int, 3> descriptors = {at.in, at.out, at.err};
    for (int n = 0; n < 3; ++n) {
      const int descriptor = descriptors[static_cast<std::size_t>(n)];
      if (descriptor >= 0) ::posix_spawn_file_actions_adddup2(&first, descriptor, n);
    }
    const int error = ::posix_spawnp(&pid_, program.c_str(), &first, nullptr, arguments.data(), environ);
    ::posix_spawn_file_actions_destroy(&first);
    if (error != 0) throw std::runtime_error("cannot start " + program);
  }
  ~Child() {
    if (ended()) return;
    signal(SIGKILL);
    wait();
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  [[nodiscard]] pid_t pid() const { return pid_; }
  /// False where its end is known already.
  bool signal(int number) const { return !status_ && ::kill(pid_, number) == 0; }
  bool ended() { return reap(WNOHANG); }
  void wait() { reap(0); }
  /// Its exit code, after its end; of one that a signal killed, 1000 and its number.
  [[nodiscard]] int exit_code() const {
    return WIFEXITED(status_.value()) ? WEXITSTATUS(*status_) : 1000 + WTERMSIG(*status_);
  }

 private:
  bool reap(int options) {
    int status = 0;
    if (!status_ && ::waitpid(pid_, &status, options) == pid_) status_ = status;
    return status_.has_value();
  }

  pid_t pid_ = -1;
  std::optional<int> status_;
};

/// The standard output of a shell line. Throws std::runtime_error if there is no shell.
inline std::string output_of(const std::string& command) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(::popen(command.c_str(), "r"), ::pclose);
  if (!pipe) throw std::runtime_error("cannot run " + command);
  std::string text;
  std::array<char, 65536> part{};
  for (std::size_t n = 0; (n = std::fread(part.data(), 1, part.size(), pipe.get())) > 0;) text.append(part.data(), n);
  return text;
}

}  // namespace fencepost::test
