// All threads of all programs below this one, as /proc shows them.
#pragma once

#include <dirent.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "hal/linux/descriptor.hpp"

namespace fencepost::stage {

using linux::Descriptor;

/// A file of /proc, open for many looks.
class ProcFile {
 public:
  explicit ProcFile(const std::string& path) : file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}
  /// Its content now; empty when its thread is gone.
  [[nodiscard]] std::string text() const {
    std::array<char, 4096> buffer;
    const ssize_t size = file_.open() ? ::pread(file_.get(), buffer.data(), buffer.size(), 0) : 0;
    return {buffer.data(), static_cast<std::size_t>(std::max<ssize_t>(size, 0))};
  }

 private:
  Descriptor file_;
};

class Task {
 public:
  Task(pid_t process, pid_t thread) : stat_(folder(process, thread) + "/stat") {}
  /// As ps(1) shows it; 'X' when it is gone.
  [[nodiscard]] char state() const {
    const std::string stat = stat_.text();
    const std::size_t name_end = stat.rfind(')');
    return name_end == std::string::npos ? 'X' : stat[name_end + 2];
  }
  /// It runs, or is about to: threads that sleep, are stopped or have ended do nothing until another one lets them.
  [[nodiscard]] bool works() const {
    const char now = state();
    return now == 'R' || now == 'D';
  }

  static std::string folder(pid_t process, pid_t thread) {
    return "/proc/" + std::to_string(process) + "/task/" + std::to_string(thread);
  }

 private:
  ProcFile stat_;
};

class Tasks {
 public:
  /// None works, and none did meanwhile: all share this thread's processor, which it has kept.
  bool rest() {
    const std::int64_t gave_way = times_it_gave_way();
    return none_was_seen_at_work() && times_it_gave_way() == gave_way;
  }

 private:
  static std::int64_t times_it_gave_way() {
    rusage usage{};
    ::getrusage(RUSAGE_THREAD, &usage);
    return usage.ru_nvcsw + usage.ru_nivcsw;
  }
  /// New ones are found by the number that the system gave last.
  bool none_was_seen_at_work() {
    if (any_works()) return false;
    const std::string last = last_number();
    if (last == seen_) return true;
    // A fork gives the number before the child is in its parent's list. Only a parent that rests has all of its
    // children there: so the list must be the same when it is read again.
    find_all();
    const std::vector<pid_t> found = numbers_;
    if (any_works()) return false;
    find_all();
    if (numbers_ != found || any_works() || last_number() != last) return false;
    seen_ = last;
    return true;
  }
  [[nodiscard]] bool any_works() const {
    return std::any_of(tasks_.begin(), tasks_.end(), [](const Task& task) { return task.works(); });
  }
  [[nodiscard]] std::string last_number() const {
    const std::string text = load_.text();
    return text.substr(text.rfind(' ') + 1);
  }
  void find_all() {
    tasks_.clear();
    numbers_.clear();
    std::vector<pid_t> processes = {::getpid()};
    for (std::size_t i = 0; i < processes.size(); ++i) {
      DIR* folder = ::opendir(("/proc/" + std::to_string(processes[i]) + "/task").c_str());
      if (folder == nullptr) continue;
      while (const dirent* entry = ::readdir(folder)) {
        if (entry->d_name[0] != '.') add(processes[i], std::atoi(entry->d_name), processes);
      }
      ::closedir(folder);
    }
  }
  void add(pid_t process, pid_t thread, std::vector<pid_t>& processes) {
    if (process != ::getpid()) {
      tasks_.emplace_back(process, thread);
      numbers_.push_back(thread);
    }
    const std::string children = ProcFile(Task::folder(process, thread) + "/children").text();
    for (std::size_t at = 0; at + 1 < children.size(); at = children.find(' ', at) + 1) {
      processes.push_back(std::atoi(&children[at]));
    }
  }

  ProcFile load_{"/proc/loadavg"};
  std::string seen_;
  std::vector<Task> tasks_;
  std::vector<pid_t> numbers_;  ///< of tasks_, in their order
};

}  // namespace fencepost::stage
