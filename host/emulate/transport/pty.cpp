#include <asm/ioctls.h>
#include <asm/termbits.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <system_error>

#include "hal/linux/descriptor.hpp"
#include "host/emulate/transport/transport.hpp"

namespace fencepost::emulate {
namespace {

namespace fs = std::filesystem;
using linux::Descriptor;

constexpr const char* kSlaveRemedy = "see 'ls /dev/pts' and the limit in /proc/sys/kernel/pty/max";

/// Raw 8 bits, at `baud` if that is not 0: of a pty both ends share the settings.
void make_raw(int fd, std::uint32_t baud) {
  termios2 line{};
  if (::ioctl(fd, TCGETS2, &line) != 0) return;
  line.c_iflag = 0;
  line.c_oflag = 0;
  line.c_lflag = 0;
  line.c_cflag = CS8 | CREAD | CLOCAL | (baud == 0 ? line.c_cflag & CBAUD : BOTHER);
  if (baud != 0) line.c_ispeed = line.c_ospeed = baud;
  line.c_cc[VMIN] = 1;
  line.c_cc[VTIME] = 0;
  ::ioctl(fd, TCSETS2, &line);
}

class Pty final : public Transport {
 public:
  explicit Pty(std::string link) : link_(std::move(link)) {}
  ~Pty() override { remove_link(); }
  Pty(const Pty&) = delete;
  Pty& operator=(const Pty&) = delete;

  [[nodiscard]] std::string place() const override { return link_.empty() ? name_ : link_; }

  std::string plug_in() override {
    master_ = Descriptor(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
    std::array<char, 64> name{};
    if (!master_.open() || ::grantpt(master_.get()) != 0 || ::unlockpt(master_.get()) != 0 ||
        ::ptsname_r(master_.get(), name.data(), name.size()) != 0) {
      return linux::failure("open", "a pseudo-terminal", errno, kSlaveRemedy).sentence;
    }
    name_ = name.data();
    make_raw(master_.get(), preset_baud_);
    // Opened and closed once: from then on the master reports whether somebody has it open.
    const Descriptor slave(::open(name.data(), O_RDWR | O_NOCTTY | O_CLOEXEC));
    if (!slave.open()) return linux::failure("open", name_, errno, kSlaveRemedy).sentence;
    return make_link();
  }

  void hang_up() override {
    remove_link();
    master_.close();
    connected_ = false;
  }

  bool tend() override {
    if (!master_.open()) return false;
    pollfd state{master_.get(), 0, 0};
    const bool there = ::poll(&state, 1, 0) == 0 || (static_cast<unsigned>(state.revents) & POLLHUP) == 0U;
    if (connected_ && !there) {
      // The next host starts with an empty line, and with raw settings whatever the last one left.
      ::ioctl(master_.get(), TCFLSH, TCIOFLUSH);
      make_raw(master_.get(), preset_baud_);
    }
    connected_ = there;
    return connected_;
  }

  Bytes read() override {
    Bytes bytes(4'096);
    const ssize_t count = master_.open() ? ::read(master_.get(), bytes.data(), bytes.size()) : 0;
    bytes.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
    return bytes;
  }

  std::size_t write(const Bytes& bytes) override {
    const ssize_t count = connected_ ? ::write(master_.get(), bytes.data(), bytes.size()) : 0;
    return bytes.size() - (count > 0 ? static_cast<std::size_t>(count) : 0);
  }

  [[nodiscard]] int descriptor() const override { return connected_ ? master_.get() : -1; }

  void preset_baud(std::uint32_t baud) override {
    preset_baud_ = baud;
    if (master_.open()) make_raw(master_.get(), baud);
  }

  [[nodiscard]] std::uint32_t host_baud() const override {
    termios2 line{};
    return master_.open() && ::ioctl(master_.get(), TCGETS2, &line) == 0 ? line.c_ospeed : 0;
  }

 private:
  std::string make_link() {
    if (link_.empty()) return {};
    std::error_code error;
    // Left by a run that was killed.
    if (fs::is_symlink(fs::symlink_status(link_, error)) && !fs::exists(link_, error)) fs::remove(link_, error);
    error.clear();
    fs::create_symlink(name_, link_, error);
    linked_ = !error;
    if (linked_) return {};
    return linux::failure("make the link", link_, error.value(),
                          error == std::errc::file_exists ? "remove it, or choose another path"
                                                          : "choose a path in a folder that you may write to")
        .sentence;
  }

  void remove_link() {
    std::error_code error;
    if (linked_ && fs::read_symlink(link_, error) == name_) fs::remove(link_, error);
    linked_ = false;
  }

  std::string link_;
  std::string name_;
  Descriptor master_;
  std::uint32_t preset_baud_ = 0;
  bool connected_ = false;
  bool linked_ = false;
};

}  // namespace

OpenedTransport open_pty(const std::string& link) {
  auto pty = std::make_unique<Pty>(link);
  if (const std::string problem = pty->plug_in(); !problem.empty()) return linux::Problem{problem};
  return OpenedTransport(std::move(pty));
}

}  // namespace fencepost::emulate
