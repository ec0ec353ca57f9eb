#include "tests/boards/turns.hpp"

#include <dlfcn.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <cstdlib>

namespace fencepost::test {
namespace {

using Wait = int (*)(pthread_cond_t*, pthread_mutex_t*);

// Not the one that the preloaded plugin puts before it.
int really_wait(pthread_cond_t* condition, pthread_mutex_t* mutex) {
  static const auto function = reinterpret_cast<Wait>(::dlsym(RTLD_NEXT, "pthread_cond_wait"));
  return function(condition, mutex);
}

class Locked {
 public:
  explicit Locked(pthread_mutex_t& mutex) : mutex_(mutex) { ::pthread_mutex_lock(&mutex_); }
  ~Locked() { ::pthread_mutex_unlock(&mutex_); }
  Locked(const Locked&) = delete;
  Locked& operator=(const Locked&) = delete;

 private:
  pthread_mutex_t& mutex_;
};

}  // namespace

void Turns::begin() {
  main_ = ::pthread_self();
  doorbell_ = ::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
  begun_ = doorbell_ >= 0;
}

void Turns::begin_core() {
  if (core_begun_) return;
  core_ = ::pthread_self();
  core_begun_ = true;
  let_main_look();
}

bool Turns::is_main() const { return begun_ && ::pthread_equal(::pthread_self(), main_) != 0; }
bool Turns::is_core() const { return core_begun_ && ::pthread_equal(::pthread_self(), core_) != 0; }

std::uint64_t Turns::requests() {
  std::uint64_t rings = 0;
  if (::read(doorbell_, &rings, sizeof rings) < 0) rings = 0;
  const Locked lock(mutex_);
  return requested_;
}

void Turns::main_rests(std::uint64_t requests) {
  const Locked lock(mutex_);
  answered_ = requests;
  main_busy_ = false;
  ::pthread_cond_broadcast(&changed_);
}

void Turns::main_works() {
  const Locked lock(mutex_);
  wait_until([this] { return core_held_; });
  main_busy_ = true;
}

void Turns::main_waits(bool waits) {
  const Locked lock(mutex_);
  main_waits_ = waits;
  main_busy_ = !waits;
  ::pthread_cond_broadcast(&changed_);
}

void Turns::core_sleeps(bool sleeps) {
  const Locked lock(mutex_);
  core_held_ = sleeps;
  ::pthread_cond_broadcast(&changed_);
}

void Turns::wait_for_main(bool look_for_more) {
  const Locked lock(mutex_);
  if (look_for_more) {
    ++requested_;
    const std::uint64_t one = 1;
    if (::write(doorbell_, &one, sizeof one) < 0) std::abort();
  }
  const std::uint64_t mine = look_for_more ? requested_ : answered_;
  core_held_ = true;
  ::pthread_cond_broadcast(&changed_);
  wait_until([&] { return main_waits_ || (!main_busy_ && answered_ >= mine); });
  core_held_ = false;
}

void Turns::wait_until(auto&& condition) {
  while (!condition()) really_wait(&changed_, &mutex_);
}

}  // namespace fencepost::test
