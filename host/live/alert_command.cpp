#include "host/live/alert_command.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <pthread.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <string_view>
#include <utility>

namespace fencepost::host {
namespace {

constexpr std::string_view kOurs = "FENCEPOST_";
/// Time that a process has to end after SIGKILL.
constexpr std::chrono::milliseconds kKillGrace{200};
constexpr std::chrono::milliseconds kPoll{2};  // between looks whether a command has ended

/// Attributes of the new process, before its shell. It has a process group of its own: Ctrl-C does not reach it, and
/// all its children can be killed together. Signals are as a shell expects them, and none of our files is open.
class Spawning {
 public:
  Spawning() {
    sigset_t all;
    sigset_t none;
    ::sigfillset(&all);
    ::sigemptyset(&none);
    ::posix_spawnattr_init(&attributes);
    ::posix_spawnattr_setpgroup(&attributes, 0);
    ::posix_spawnattr_setsigmask(&attributes, &none);
    ::posix_spawnattr_setsigdefault(&attributes, &all);
    ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO);
    ::posix_spawn_file_actions_addclosefrom_np(&actions, STDERR_FILENO + 1);
  }
  ~Spawning() {
    ::posix_spawnattr_destroy(&attributes);
    ::posix_spawn_file_actions_destroy(&actions);
  }
  Spawning(const Spawning&) = delete;
  Spawning& operator=(const Spawning&) = delete;

  posix_spawnattr_t attributes{};
  posix_spawn_file_actions_t actions{};
};

std::vector<char*> pointers_to(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

std::vector<std::string> whole_environment(const AlertNow& alert) {
  std::vector<std::string> all = environment_of(alert);
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view text = *entry;
    if (!text.starts_with(kOurs)) all.emplace_back(text);
  }
  return all;
}

std::string fault_of(int status) {
  if (WIFSIGNALED(status)) return fmt::format("was ended by signal {}", WTERMSIG(status));
  switch (WEXITSTATUS(status)) {
    case 0: return {};
    case 126: return "ended with exit code 126: it may not be executed; try chmod +x";
    case 127: return "ended with exit code 127: the shell did not find it; give its whole path";
    default: return fmt::format("ended with exit code {}", WEXITSTATUS(status));
  }
}

/// Its status, or nothing if it still runs after `limit`.
std::optional<int> wait_for(pid_t pid, std::chrono::milliseconds limit) {
  const auto end = std::chrono::steady_clock::now() + limit;
  int status = 0;
  while (::waitpid(pid, &status, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() >= end) return std::nullopt;
    std::this_thread::sleep_for(kPoll);
  }
  return status;
}

}  // namespace

std::vector<std::string> environment_of(const AlertNow& alert) {
  const auto& of = alert.of;
  const auto number = [](double value) { return fmt::format("{:.4f}", value); };
  return {fmt::format("FENCEPOST_LEVEL={}", name(alert.beat.level)),
          fmt::format("FENCEPOST_ID={}", of ? std::to_string(of->id) : ""),
          fmt::format("FENCEPOST_COLOUR={}", alert.colour),
          fmt::format("FENCEPOST_DISTANCE={}", of ? number(of->distance.to_double()) : ""),
          fmt::format("FENCEPOST_BEARING={}", of ? number(of->bearing.to_double()) : ""),
          fmt::format("FENCEPOST_TTC={}", of && of->ttc ? number(of->ttc->to_double()) : ""),
          fmt::format("FENCEPOST_CAMERA={}", name(alert.beat.camera)),
          fmt::format("FENCEPOST_ODOMETRY={}", name(alert.beat.odometry)),
          fmt::format("FENCEPOST_TIME={}", number(alert.beat.t.to_double()))};
}

// Signals are handled by the thread that waits for them.
AlertCommand::AlertCommand(std::string line, std::chrono::milliseconds longest, Kill kill)
    : line_(std::move(line)), longest_(longest), kill_(kill) {
  sigset_t all;
  sigset_t before;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &before);
  thread_ = std::thread([this] { work(); });
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

AlertCommand::~AlertCommand() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void AlertCommand::show(const AlertNow& alert, base::Time /*now*/) {
  if (level_ != alert.beat.level) push(alert);
}

void AlertCommand::end(base::Time /*now*/) {
  if (!level_ || *level_ < record::AlertLevel::kStop) push({});
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !due_ && !busy_; });
}

std::vector<std::string> AlertCommand::messages() {
  const std::lock_guard lock(mutex_);
  return std::exchange(messages_, {});
}

void AlertCommand::push(const AlertNow& alert) {
  level_ = alert.beat.level;
  {
    const std::lock_guard lock(mutex_);
    due_ = alert;
  }
  changed_.notify_all();
}

void AlertCommand::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return stop_ || due_; });
    if (!due_) return;
    const AlertNow alert = *std::exchange(due_, std::nullopt);
    busy_ = true;
    lock.unlock();
    const std::string fault = run(alert);
    lock.lock();
    busy_ = false;
    note(fault, alert.beat.level);
    changed_.notify_all();
  }
}

// Said again only when something else was the matter meanwhile.
void AlertCommand::note(const std::string& fault, record::AlertLevel level) {
  if (!fault.empty() && fault != last_fault_) {
    messages_.push_back(fmt::format("--on-alert: the command for level {} {}", name(level), fault));
  }
  last_fault_ = fault;
}

std::string AlertCommand::run(const AlertNow& alert) {
  std::erase_if(given_up_, [](pid_t pid) { return ::waitpid(pid, nullptr, WNOHANG) != 0; });
  const Spawning spawning;
  std::vector<std::string> words = {"sh", "-c", line_, "sh", std::string(name(alert.beat.level))};
  std::vector<std::string> environment = whole_environment(alert);
  pid_t pid = -1;
  const int error = ::posix_spawn(&pid, "/bin/sh", &spawning.actions, &spawning.attributes, pointers_to(words).data(),
                                  pointers_to(environment).data());
  if (error != 0) return fmt::format("cannot be started: {}", std::strerror(error));
  const std::optional<int> status = wait_for(pid, longest_);
  return status ? fault_of(*status) : end_hung(pid);
}

// The process itself is signalled as well as its group, which it may have left.
std::string AlertCommand::end_hung(pid_t pid) {
  const double seconds = std::chrono::duration<double>(longest_).count();
  kill_(-pid, SIGKILL);
  const int error = kill_(pid, SIGKILL) == 0 ? 0 : errno;
  const bool ended = wait_for(pid, kKillGrace).has_value();
  if (!ended) given_up_.push_back(pid);
  // Without the process, its group is gone, is ending, or has members of another user.
  const bool group_lives = ended && kill_(-pid, 0) != 0 && errno == EPERM;
  if (ended && !group_lives) {
    return fmt::format("still ran after {:.1f} s and was killed; let it begin long work with '&'", seconds);
  }
  const int reason = group_lives ? EPERM : error;
  return fmt::format(
      "still ran after {:.1f} s and cannot be killed ({}); commands of later levels run beside it; a program under "
      "sudo needs its own time limit",
      seconds, reason != 0 ? std::strerror(reason) : "the system holds it");
}

}  // namespace fencepost::host
