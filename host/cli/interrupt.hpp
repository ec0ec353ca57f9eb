// Ctrl-C: exit 130, nothing half-written left behind.
#pragma once

#include <string>

namespace fencepost::host::cli {

/// From here on an interrupt ends the program with exit code 130. A closed pipe and a file that may not grow become
/// errors of write().
void handle_interrupts();

/// A line of progress is on the terminal, or no longer: an interrupt takes it away.
void note_progress_line(bool shown);

/// During its lifetime an interrupt removes that file. One at a time.
class RemoveOnInterrupt {
 public:
  explicit RemoveOnInterrupt(const std::string& path);
  ~RemoveOnInterrupt();
  RemoveOnInterrupt(const RemoveOnInterrupt&) = delete;
  RemoveOnInterrupt& operator=(const RemoveOnInterrupt&) = delete;
};

}  // namespace fencepost::host::cli
