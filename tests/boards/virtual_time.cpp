// A plugin of QEMU (TCG plugin API, version 1), which is preloaded, too. Emulated time passes only as a test says, and
// a run repeats itself to the instruction.
//
// With `-icount shift=N,sleep=off` an instruction takes 2^N ns and sleep takes none. But QEMU's own loop, which brings
// the bytes of the lines and moves the clock of a sleeping core, is a thread of its own. Its work falls anywhere
// between two instructions. Here it gets its turn only while the core is held, and until it has nothing left to do.
// Both threads are caught where they call the C library: ppoll() and pthread_cond_wait().
//
// Arguments: control=SOCKET, tick=ADDRESS of the interrupt that comes each millisecond, shift=N. At each tick
// `at MICROSECONDS` goes to the socket and a character comes back. `g`: go on. `f`: bytes wait in the lines. It then
// looks for them when the core is about to sleep, and after a byte's time on a line of 115200 baud.
#include <dlfcn.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "tests/boards/qemu_plugin.hpp"
#include "tests/boards/turns.hpp"

int qemu_plugin_version = 1;

namespace fencepost::test {
namespace {

constexpr std::uint64_t kTickMicros = 1'000;
constexpr std::uint64_t kMissedNanos = 1'500'000;  // without a tick: it is not running, or held off
constexpr std::uint64_t kByteNanos = 86'806;       // ten bits
constexpr std::uint16_t kSleep = 0xBF30;           // WFI

// Never destroyed: main goes on polling after the destructors of static objects.
Turns& turns = *new Turns;

class Clock {
 public:
  void connect(const std::string& path) {
    control_ = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.copy(std::begin(address.sun_path), sizeof address.sun_path - 1);
    if (::connect(control_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) std::abort();
  }
  void set_shift(unsigned shift) {
    missed_ = kMissedNanos >> shift;
    byte_ = kByteNanos >> shift;
  }

  /// Before a block of so many instructions.
  void pass(std::uint64_t instructions) {
    if (since_tick_ >= missed_) {
      ask(kMissedNanos / 1'000);
    } else if (bytes_wait_ && since_byte_ >= byte_) {
      look();
    }
    since_tick_ += instructions;
    since_byte_ += instructions;
  }
  void tick() { ask(kTickMicros); }
  void sleep() {
    if (bytes_wait_) look();
  }

 private:
  void look() {
    turns.let_main_look();
    since_byte_ = 0;
  }
  void ask(std::uint64_t passed) {
    micros_ += passed;
    since_tick_ = 0;
    char line[32];
    const int size = std::snprintf(line, sizeof line, "at %llu\n", static_cast<unsigned long long>(micros_));
    char answer = 0;
    if (::write(control_, line, static_cast<std::size_t>(size)) != size || ::read(control_, &answer, 1) != 1) {
      ::_exit(0);  // the test is over
    }
    bytes_wait_ = answer == 'f';
    look();
  }

  int control_ = -1;
  std::uint64_t missed_ = 0;
  std::uint64_t byte_ = 0;
  std::uint64_t micros_ = 0;
  std::uint64_t since_tick_ = 0;  // instructions
  std::uint64_t since_byte_ = 0;
  bool bytes_wait_ = false;
};
Clock& emulated = *new Clock;
std::uint64_t tick_address = 0;

// Main may have begun something while the core slept.
void on_block(unsigned /*cpu*/, void* data) {
  turns.begin_core();
  turns.hold_core();
  emulated.pass(reinterpret_cast<std::uintptr_t>(data));
}
void on_tick(unsigned /*cpu*/, void* /*data*/) { emulated.tick(); }
void on_sleep(unsigned /*cpu*/, void* /*data*/) { emulated.sleep(); }

void on_translation(PluginId /*id*/, qemu_plugin_tb* tb) {
  const std::size_t count = qemu_plugin_tb_n_insns(tb);
  qemu_plugin_register_vcpu_tb_exec_cb(tb, on_block, kNoRegisters, reinterpret_cast<void*>(count));
  if (qemu_plugin_tb_vaddr(tb) == tick_address) {
    qemu_plugin_register_vcpu_tb_exec_cb(tb, on_tick, kNoRegisters, nullptr);
  }
  for (std::size_t i = 0; i < count; ++i) {
    qemu_plugin_insn* instruction = qemu_plugin_tb_get_insn(tb, i);
    std::uint16_t code = 0;
    if (qemu_plugin_insn_size(instruction) != sizeof code) continue;
    std::memcpy(&code, qemu_plugin_insn_data(instruction), sizeof code);
    if (code == kSleep) qemu_plugin_register_vcpu_insn_exec_cb(instruction, on_sleep, kNoRegisters, nullptr);
  }
}

template <class Function>
Function next_of(const char* name) {
  return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}
using Poll = int (*)(pollfd*, nfds_t, const timespec*, const sigset_t*);
using Wait = int (*)(pthread_cond_t*, pthread_mutex_t*);

// Main's: returns when it has something to do and its turn has come.
int poll_in_turn(Poll really, pollfd* files, nfds_t count, const timespec* patience, const sigset_t* signals) {
  const timespec now{};
  const std::uint64_t requests = turns.requests();
  int ready = really(files, count, &now, signals);
  if (ready != 0 || (patience != nullptr && patience->tv_sec == 0 && patience->tv_nsec == 0)) return ready;
  turns.main_rests(requests);
  std::vector<pollfd> with_bell(files, files + count);
  with_bell.push_back({turns.doorbell(), POLLIN, 0});
  really(with_bell.data(), with_bell.size(), patience, signals);
  turns.main_works();
  return really(files, count, &now, signals);
}

}  // namespace
}  // namespace fencepost::test

using fencepost::test::turns;

extern "C" [[gnu::visibility("default")]] int ppoll(pollfd* files, nfds_t count, const timespec* patience,
                                                    const sigset_t* signals) {
  static const auto really = fencepost::test::next_of<fencepost::test::Poll>("ppoll");
  if (!turns.is_main()) return really(files, count, patience, signals);
  return fencepost::test::poll_in_turn(really, files, count, patience, signals);
}

extern "C" [[gnu::visibility("default")]] int pthread_cond_wait(pthread_cond_t* condition, pthread_mutex_t* mutex) {
  static const auto really = fencepost::test::next_of<fencepost::test::Wait>("pthread_cond_wait");
  if (turns.is_core()) {
    turns.core_sleeps(true);
    const int result = really(condition, mutex);
    turns.core_sleeps(false);
    return result;
  }
  if (!turns.is_main()) return really(condition, mutex);
  turns.main_waits(true);
  const int result = really(condition, mutex);
  turns.main_waits(false);
  return result;
}

int qemu_plugin_install(PluginId id, const void* /*info*/, int argc, char** argv) {
  for (int i = 0; i < argc; ++i) {
    const std::string argument = argv[i];
    const std::string value = argument.substr(argument.find('=') + 1);
    if (argument.starts_with("control=")) fencepost::test::emulated.connect(value);
    if (argument.starts_with("tick=")) {
      fencepost::test::tick_address = std::strtoull(value.c_str(), nullptr, 16) & ~1ULL;
    }
    if (argument.starts_with("shift=")) {
      fencepost::test::emulated.set_shift(static_cast<unsigned>(std::strtoul(value.c_str(), nullptr, 10)));
    }
  }
  turns.begin();
  qemu_plugin_register_vcpu_tb_trans_cb(id, fencepost::test::on_translation);
  return 0;
}
