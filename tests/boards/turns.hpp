// Which of QEMU's two threads runs. One is its own loop, called main here, which brings the bytes of the lines and
// moves the clock of a sleeping core. The other is the core, which translates and executes. Never both.
#pragma once

#include <pthread.h>

#include <atomic>
#include <cstdint>

namespace fencepost::test {

class Turns {
 public:
  /// By main, once, before there is a core.
  void begin();
  /// By the core, before what it does first.
  void begin_core();

  [[nodiscard]] bool is_main() const;
  [[nodiscard]] bool is_core() const;
  /// Readable while the core asks for main.
  [[nodiscard]] int doorbell() const { return doorbell_; }

  // By main.
  /// What the core has asked for; the bell is silent again.
  [[nodiscard]] std::uint64_t requests();
  /// It has nothing left to do, and had not since it read `requests`.
  void main_rests(std::uint64_t requests);
  /// Waits until the core is held.
  void main_works();
  /// It waits for something that the core has to do, until main_waits(false).
  void main_waits(bool waits);

  // By the core.
  void core_sleeps(bool sleeps);
  /// Held until main has done what it began while the core slept.
  void hold_core() {
    if (main_busy_) wait_for_main(false);
  }
  /// Held until main has looked for more, too.
  void let_main_look() { wait_for_main(true); }

 private:
  void wait_for_main(bool look_for_more);
  void wait_until(auto&& condition);

  pthread_t main_{};
  pthread_t core_{};
  bool begun_ = false;
  bool core_begun_ = false;
  int doorbell_ = -1;
  std::atomic<bool> main_busy_{true};  // written under the mutex
  pthread_mutex_t mutex_ = PTHREAD_MUTEX_INITIALIZER;
  pthread_cond_t changed_ = PTHREAD_COND_INITIALIZER;
  // Guarded by the mutex:
  bool core_held_ = true;
  bool main_waits_ = false;
  std::uint64_t requested_ = 0;
  std::uint64_t answered_ = 0;
};

}  // namespace fencepost::test
