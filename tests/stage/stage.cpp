// usage: stage PROGRAM [ARGUMENT...]: runs it, and whatever it starts, on a clock that moves only while all of them
// wait.
//
// A thread says when it begins to wait and until when. The clock jumps to the earliest deadline once every thread of
// every program waits or sleeps. That one thread goes on.
#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <vector>

#include "tests/folder.hpp"
#include "tests/stage/message.hpp"
#include "tests/stage/tasks.hpp"

namespace fencepost::stage {
namespace {

/// The clock shows it first, ns: the machine has been on for a while.
constexpr std::int64_t kStart = 1'000 * kNanosecondsPerSecond;
/// Real time until threads that say nothing are looked at, at first, ns.
constexpr std::int64_t kFirstPauseNs = 50'000;
/// The same at most, ns: it doubles while they work.
constexpr std::int64_t kMaxPauseNs = 2'000'000;

struct Thread {
  enum class State { kWorks, kSilent, kWaits, kAsked };
  Descriptor connection;
  State state = State::kWorks;
  Message said;
};

class Stage {
 public:
  Stage() {
    ::chmod(folder_.path().c_str(), 0755);
    open_board();
    listen();
    ::setenv(kVariable, folder_.path().c_str(), 1);
  }

  /// Its exit code.
  int run(char** words) {
    stay_on_one_processor();
    ::prctl(PR_SET_CHILD_SUBREAPER, 1);  // a program that loses its parent stays on the stage
    const pid_t program = start(words);
    std::int64_t pause = kFirstPauseNs;
    while (true) {
      if (listen_to_all(pause)) {
        pause = kFirstPauseNs;
        advance();
      } else if (const auto code = reap(program)) {
        return *code;
      } else {
        pause = pass_over_silent() && advance() ? kFirstPauseNs : std::min(2 * pause, kMaxPauseNs);
      }
    }
  }

 private:
  void open_board() {
    const Descriptor file(::open((folder_.path().string() + kBoard).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
    if (::ftruncate(file.get(), sizeof(Board)) != 0) std::abort();
    void* mapped = ::mmap(nullptr, sizeof(Board), PROT_READ | PROT_WRITE, MAP_SHARED, file.get(), 0);
    if (mapped == MAP_FAILED) std::abort();
    board_ = static_cast<Board*>(mapped);
    board_->now_ns = kStart;
  }
  void listen() {
    listener_ = Descriptor(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    (folder_.path().string() + kSocket).copy(address.sun_path, sizeof address.sun_path - 1);
    if (::bind(listener_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
        ::listen(listener_.get(), SOMAXCONN) != 0) {
      std::abort();
    }
    ::chmod(address.sun_path, 0777);
  }

  /// Everything here takes turns, which costs least on one processor; which one differs from stage to stage.
  static void stay_on_one_processor() {
    cpu_set_t allowed;
    ::sched_getaffinity(0, sizeof allowed, &allowed);
    int left = ::getpid() % CPU_COUNT(&allowed);
    for (std::size_t processor = 0; processor < CPU_SETSIZE; ++processor) {
      if (!CPU_ISSET(processor, &allowed) || left-- > 0) continue;
      CPU_ZERO(&allowed);
      CPU_SET(processor, &allowed);
      break;
    }
    ::sched_setaffinity(0, sizeof allowed, &allowed);
  }
  static pid_t start(char** words) {
    const pid_t program = ::fork();
    if (program != 0) return program;
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    ::execvp(words[0], words);
    std::perror(words[0]);
    ::_exit(127);
  }
  static std::optional<int> reap(pid_t program) {
    int status = 0;
    while (const pid_t ended = ::waitpid(-1, &status, WNOHANG)) {
      if (ended < 0) return 1;
      if (ended != program) continue;
      return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }
    return std::nullopt;
  }

  /// Waits for words of the threads, and takes all there are. False: none came.
  bool listen_to_all(std::int64_t patience_ns) {
    std::vector<pollfd> watched = {{listener_.get(), POLLIN, 0}};
    for (const Thread& thread : threads_) watched.push_back({thread.connection.get(), POLLIN, 0});
    const timespec patience{0, patience_ns};
    if (::ppoll(watched.data(), watched.size(), &patience, nullptr) <= 0) return false;
    for (std::size_t i = threads_.size(); i-- > 0;) {
      if (watched[i + 1].revents != 0 && !listen_to(threads_[i])) {
        threads_.erase(threads_.begin() + static_cast<std::ptrdiff_t>(i));
        changed_ = true;
      }
    }
    while (watched.front().revents != 0) {
      Descriptor next(::accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
      if (!next.open()) break;
      threads_.push_back({std::move(next), Thread::State::kWorks, {}});
      changed_ = true;
    }
    return true;
  }
  /// False: it has gone.
  bool listen_to(Thread& thread) {
    Message message;
    ssize_t size = 0;
    while ((size = ::recv(thread.connection.get(), &message, sizeof message, 0)) == sizeof message) {
      switch (message.word) {
        case Word::kWait: thread.state = Thread::State::kWaits; break;
        case Word::kIdle:
          if (thread.state == Thread::State::kAsked) thread.state = Thread::State::kWaits;
          break;
        default: thread.state = Thread::State::kWorks; break;
      }
      if (message.word == Word::kIdle) continue;
      thread.said = message;
      changed_ = true;
    }
    return size < 0;
  }

  /// Moves the clock to the earliest deadline, if there is nothing to do before. False: there is, or no deadline.
  bool advance() {
    const auto works = [](const Thread& thread) { return thread.state == Thread::State::kWorks; };
    if (std::any_of(threads_.begin(), threads_.end(), works)) return false;
    if (!tasks_.rest() || listen_to_all(0) || !all_has_arrived()) return false;
    Thread* first = nullptr;
    for (Thread& thread : threads_) {
      if (thread.state != Thread::State::kWaits) continue;
      if (first == nullptr || thread.said.deadline_ns < first->said.deadline_ns) first = &thread;
    }
    if (first == nullptr || first->said.deadline_ns == kNever) return false;
    board_->now_ns = std::max(board_->now_ns.load(), first->said.deadline_ns);
    first->state = Thread::State::kWorks;
    tell(*first, Word::kTime);
    return true;
  }

  /// Bytes on their way through a terminal arrive when its other end is polled: each thread that waits does so now.
  /// False: a thread has become awake.
  bool all_has_arrived() {
    const std::uint64_t written = board_->written;
    if (written == arrived_) return true;
    changed_ = false;
    for (Thread& thread : threads_) {
      if (thread.state != Thread::State::kWaits) continue;
      thread.state = Thread::State::kAsked;
      tell(thread, Word::kCheck);
    }
    const auto asked = [](const Thread& thread) { return thread.state == Thread::State::kAsked; };
    while (std::any_of(threads_.begin(), threads_.end(), asked)) {
      if (!listen_to_all(kMaxPauseNs)) pass_over_stopped();
    }
    if (!changed_) arrived_ = written;
    return !changed_;
  }

  /// Threads that sleep without a word, in a call that the stage does not know, hold nobody up.
  bool pass_over_silent() {
    if (!tasks_.rest() || listen_to_all(0)) return false;
    for (Thread& thread : threads_) {
      if (thread.state == Thread::State::kWorks) thread.state = Thread::State::kSilent;
    }
    return true;
  }

  /// A thread that SIGSTOP holds answers when it goes on.
  void pass_over_stopped() {
    for (Thread& thread : threads_) {
      const bool asked = thread.state == Thread::State::kAsked;
      if (asked && Task(thread.said.process, thread.said.thread).state() == 'T') {
        thread.state = Thread::State::kWaits;
      }
    }
  }

  static void tell(const Thread& thread, Word word) {
    const Message message{word, thread.said.wait, kNever, 0, 0};
    ::send(thread.connection.get(), &message, sizeof message, MSG_NOSIGNAL);
  }

  test::Folder folder_;
  Board* board_ = nullptr;
  std::uint64_t arrived_ = 0;  ///< Board::written, at the last time when all of it had arrived
  Descriptor listener_;
  std::vector<Thread> threads_;
  Tasks tasks_;
  bool changed_ = false;  ///< a thread has said something else than that it is idle
};

}  // namespace
}  // namespace fencepost::stage

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: stage PROGRAM [ARGUMENT...]\n");
    return 2;
  }
  ::setenv("LD_PRELOAD", FENCEPOST_STAGED, 1);
  // The sanitizers' library need not be the first.
  ::setenv("ASAN_OPTIONS", "verify_asan_link_order=0", 1);
  return fencepost::stage::Stage().run(argv + 1);
}
