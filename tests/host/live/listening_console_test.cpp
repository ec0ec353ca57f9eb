// People come and go at a console that listens; the robot goes on.
#include "host/live/listening_console.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <string>

#include "host/live/open_port.hpp"
#include "tests/text.hpp"

namespace fencepost::host {
namespace {

using test::octets;

/// Somebody who connects.
class Person {
 public:
  explicit Person(const std::string& address) : fd_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(static_cast<std::uint16_t>(std::stoi(address.substr(address.rfind(':') + 1))));
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    connected_ = ::connect(fd_.get(), static_cast<sockaddr*>(static_cast<void*>(&to)), sizeof to) == 0;
  }
  [[nodiscard]] bool connected() const { return connected_; }
  void type(const std::string& text) const {
    EXPECT_EQ(::send(fd_.get(), text.data(), text.size(), 0), ssize_t(text.size()));
  }
  /// Until nothing has come for a while, or the other end has gone.
  [[nodiscard]] std::string read() const {
    std::string text;
    pollfd wait{fd_.get(), POLLIN, 0};
    while (::poll(&wait, 1, 100) > 0) {
      std::array<char, 256> buffer{};
      const ssize_t count = ::recv(fd_.get(), buffer.data(), buffer.size(), 0);
      if (count <= 0) return text + "<end>";
      text.append(buffer.data(), static_cast<std::size_t>(count));
    }
    return text;
  }
  void leave() { fd_.close(); }

 private:
  linux::Descriptor fd_;
  bool connected_ = false;
};

std::string typed_into(ListeningConsole& console) {
  std::array<std::uint8_t, 256> buffer{};
  for (int i = 0; i < 100; ++i) {
    const auto count = console.read(buffer);
    if (count) return {buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(*count)};
    ::poll(nullptr, 0, 5);
  }
  return {};
}

TEST(ListeningConsole, TalksToWhoeverIsThere) {
  const auto console = ListeningConsole::open("127.0.0.1", 0);
  EXPECT_TRUE(console->address().starts_with("tcp:127.0.0.1:")) << console->address();
  EXPECT_FALSE(console->connected());
  EXPECT_EQ(console->write(octets("lost\n")).error(), base::Error::kGone);

  Person first(console->address());
  ASSERT_TRUE(first.connected());
  console->tend({});
  ASSERT_TRUE(console->connected());
  EXPECT_EQ(*console->write(octets("hello\n")), 6U);
  EXPECT_EQ(first.read(), "hello\n");
  first.type("status\r");
  EXPECT_EQ(typed_into(*console), "status\r");
}

TEST(ListeningConsole, OneAtATimeAndTheNextWhenThatHasLeft) {
  const auto console = ListeningConsole::open("127.0.0.1", 0);
  Person first(console->address());
  console->tend({});
  Person second(console->address());
  console->tend({});
  EXPECT_EQ(second.read(), "error: somebody else is at this console; try again later\r\n<end>");
  EXPECT_EQ(*console->write(octets("to the first\n")), 13U);
  EXPECT_EQ(first.read(), "to the first\n");

  first.leave();
  EXPECT_EQ(typed_into(*console), "");
  EXPECT_FALSE(console->connected());
  Person third(console->address());
  console->tend({});
  EXPECT_TRUE(console->connected());
  EXPECT_EQ(*console->write(octets("to the third\n")), 13U);
  EXPECT_EQ(third.read(), "to the third\n");
}

TEST(ListeningConsole, SaysWhereItCannotListen) {
  const auto console = ListeningConsole::open("127.0.0.1", 0);
  const std::string port = console->address().substr(console->address().rfind(':') + 1);
  try {
    static_cast<void>(ListeningConsole::open("127.0.0.1", static_cast<std::uint16_t>(std::stoi(port))));
    FAIL() << "two listen at one port";
  } catch (const DeviceFailure& failure) {
    EXPECT_NE(failure.message.find("127.0.0.1:" + port), std::string::npos) << failure.message;
  }
  EXPECT_THROW(static_cast<void>(ListeningConsole::open("no.such.host.invalid", 4000)), DeviceFailure);
}

}  // namespace
}  // namespace fencepost::host
