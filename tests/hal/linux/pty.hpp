// A pseudo-terminal whose other end the test holds, under a path that the test chooses as udev would.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <string>
#include <string_view>

#include "hal/linux/descriptor.hpp"
#include "tests/folder.hpp"

namespace fencepost::linux {

/// The far end of a serial line. `plug` makes a fresh one and points the path to it, `unplug` hangs up.
class FarEnd {
 public:
  explicit FarEnd(std::string path) : path_(std::move(path)) { plug(); }
  ~FarEnd() { unplug(); }
  FarEnd(const FarEnd&) = delete;
  FarEnd& operator=(const FarEnd&) = delete;

  void plug() {
    master_ = Descriptor(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
    ASSERT_TRUE(master_.open());
    ASSERT_EQ(::grantpt(master_.get()), 0);
    ASSERT_EQ(::unlockpt(master_.get()), 0);
    std::array<char, 64> name{};
    ASSERT_EQ(::ptsname_r(master_.get(), name.data(), name.size()), 0);
    std::filesystem::remove(path_);
    std::filesystem::create_symlink(name.data(), path_);
  }
  void unplug() {
    master_.close();
    std::filesystem::remove(path_);
  }

  void say(std::string_view text) {
    ASSERT_EQ(::write(master_.get(), text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  /// The bytes that came so far, at most a buffer full.
  std::string heard() {
    pollfd wait{master_.get(), POLLIN, 0};
    if (::poll(&wait, 1, 1000) <= 0) return {};
    std::array<char, 65536> buffer{};
    const ssize_t count = ::read(master_.get(), buffer.data(), buffer.size());
    return count < 0 ? std::string() : std::string(buffer.data(), static_cast<std::size_t>(count));
  }
  [[nodiscard]] int descriptor() const { return master_.get(); }

 private:
  std::string path_;
  Descriptor master_;
};

}  // namespace fencepost::linux
