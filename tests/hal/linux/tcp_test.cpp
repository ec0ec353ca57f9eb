#include "hal/linux/tcp.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <string>
#include <vector>

#include "hal/linux/clock.hpp"
#include "hal/linux/wait.hpp"
#include "tests/text.hpp"

namespace fencepost::linux {
namespace {

using base::Error;
using base::milliseconds;
using base::Time;
using test::octets;

/// Listens on this machine, at a free port or at one that was free.
class Server {
 public:
  explicit Server(std::uint16_t port = 0) { listen(port); }
  void listen(std::uint16_t port) {
    listening_ = Descriptor(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
    const int yes = 1;
    ::setsockopt(listening_.get(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    auto* where = static_cast<sockaddr*>(static_cast<void*>(&address));
    ASSERT_EQ(::bind(listening_.get(), where, sizeof address), 0);
    ASSERT_EQ(::listen(listening_.get(), 1), 0);
    socklen_t size = sizeof address;
    ASSERT_EQ(::getsockname(listening_.get(), where, &size), 0);
    port_ = ntohs(address.sin_port);
  }
  void accept() {
    pollfd wait{listening_.get(), POLLIN, 0};
    ASSERT_EQ(::poll(&wait, 1, 5000), 1);
    peer_ = Descriptor(::accept(listening_.get(), nullptr, nullptr));
    ASSERT_TRUE(peer_.open());
  }
  void hang_up() { peer_.close(); }
  /// Hangs up without a farewell.
  void reset() {
    const linger none{1, 0};
    ASSERT_EQ(::setsockopt(peer_.get(), SOL_SOCKET, SO_LINGER, &none, sizeof none), 0);
    peer_.close();
  }
  void stop() {
    peer_.close();
    listening_.close();
  }
  void say(std::string_view text) {
    ASSERT_EQ(::send(peer_.get(), text.data(), text.size(), MSG_NOSIGNAL), static_cast<ssize_t>(text.size()));
  }
  std::string hear(std::size_t size) {
    std::string text(size, '\0');
    const ssize_t count = ::recv(peer_.get(), text.data(), size, MSG_WAITALL);
    text.resize(count < 0 ? 0 : static_cast<std::size_t>(count));
    return text;
  }
  [[nodiscard]] std::uint16_t port() const { return port_; }

 private:
  Descriptor listening_;
  Descriptor peer_;
  std::uint16_t port_ = 0;
};

/// The next bytes, or why there are none; waits for either.
base::Result<std::size_t> wait_and_read(Tcp& tcp, std::span<std::uint8_t> in) {
  const MonotonicClock clock;
  WaitSet set;
  set.add_readable(tcp.descriptor());
  set.wait_until(clock, Time{} + milliseconds(5000));
  return tcp.read(in);
}

/// Tends until it is connected, for at most ten seconds of its clock.
bool connects(Tcp& tcp, Time& now) {
  for (int i = 0; i < 1000 && !tcp.connected(); ++i) {
    now = now + milliseconds(10);
    tcp.tend(now);
  }
  return tcp.connected();
}

struct TcpTest : testing::Test {
  Server server;
};

TEST_F(TcpTest, CarriesBytesBothWays) {
  Opened<Tcp> tcp = Tcp::open({"127.0.0.1", server.port()});
  ASSERT_TRUE(tcp) << tcp.problem();
  server.accept();
  std::array<std::uint8_t, 8> in{};
  EXPECT_EQ(tcp->read(in).error(), Error::kNotReady);
  server.say("ping");
  ASSERT_EQ(wait_and_read(*tcp, in).value(), 4U);
  EXPECT_EQ(in[0], 'p');
  EXPECT_EQ(tcp->write(octets("pong")).value(), 4U);
  EXPECT_EQ(server.hear(4), "pong");
}

TEST_F(TcpTest, FindsNames) {
  Opened<Tcp> tcp = Tcp::open({"localhost", server.port()});
  ASSERT_TRUE(tcp) << tcp.problem();  // where it names ::1 first, that refuses and the next is tried
}

TEST_F(TcpTest, SaysWhatFailedWhereAndWhatToTry) {
  const std::uint16_t free_port = server.port();
  server.stop();
  Opened<Tcp> refused = Tcp::open({"127.0.0.1", free_port});
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.problem().find("127.0.0.1:" + std::to_string(free_port)), std::string::npos) << refused.problem();
  EXPECT_NE(refused.problem().find("nobody listens there"), std::string::npos) << refused.problem();

  Opened<Tcp> unknown = Tcp::open({"no such host", 1});
  ASSERT_FALSE(unknown.ok());
  EXPECT_NE(unknown.problem().find("no such host"), std::string::npos) << unknown.problem();
}

TEST_F(TcpTest, ComesBackAfterTheServerDid) {
  Opened<Tcp> tcp = Tcp::open({"127.0.0.1", server.port()});
  ASSERT_TRUE(tcp) << tcp.problem();
  server.accept();
  server.stop();
  std::array<std::uint8_t, 8> in{};
  EXPECT_EQ(wait_and_read(*tcp, in).error(), Error::kGone);
  EXPECT_FALSE(tcp->connected());
  EXPECT_EQ(tcp->descriptor(), -1);
  EXPECT_EQ(tcp->write(octets("x")).error(), Error::kGone);

  Time now;
  tcp->tend(now);
  EXPECT_FALSE(tcp->connected());
  EXPECT_NE(tcp->problem().find("nobody listens there"), std::string::npos) << tcp->problem();

  server.listen(server.port());
  ASSERT_TRUE(connects(*tcp, now)) << tcp->problem();
  EXPECT_TRUE(tcp->problem().empty());
  server.accept();
  server.say("again");
  EXPECT_EQ(wait_and_read(*tcp, in).value(), 5U);
}

TEST_F(TcpTest, ConnectsLaterToWhoeverComesUpByThen) {
  const std::uint16_t port = server.port();
  server.stop();
  Opened<Tcp> tcp = Tcp::later({"localhost", port});  // may name ::1 first, where nobody will listen
  ASSERT_TRUE(tcp) << tcp.problem();
  EXPECT_FALSE(tcp->connected());
  Time now;
  tcp->tend(now);
  EXPECT_FALSE(tcp->connected());
  server.listen(port);
  EXPECT_TRUE(connects(*tcp, now)) << tcp->problem();
}

TEST_F(TcpTest, LooksForTheServerFourTimesASecond) {
  Opened<Tcp> tcp = Tcp::open({"127.0.0.1", server.port()});
  ASSERT_TRUE(tcp) << tcp.problem();
  server.accept();
  server.hang_up();
  std::array<std::uint8_t, 8> in{};
  EXPECT_EQ(wait_and_read(*tcp, in).error(), Error::kGone);
  server.stop();
  tcp->tend(Time{} + milliseconds(1000));  // refused
  server.listen(server.port());
  tcp->tend(Time{} + milliseconds(1249));
  EXPECT_FALSE(tcp->connected());
  Time now = Time{} + milliseconds(1250);
  tcp->tend(now);
  EXPECT_TRUE(connects(*tcp, now));
}

TEST_F(TcpTest, FullIsNoLoss) {
  Opened<Tcp> tcp = Tcp::open({"127.0.0.1", server.port()});
  ASSERT_TRUE(tcp) << tcp.problem();
  server.accept();
  const std::string much(1 << 20, 'x');
  std::size_t sent = 0;
  base::Result<std::size_t> taken = Error::kNotReady;
  for (int i = 0; i < 1000; ++i) {
    taken = tcp->write(octets(much));
    if (!taken) break;
    sent += *taken;
  }
  ASSERT_FALSE(taken.ok());
  EXPECT_EQ(taken.error(), Error::kFull);
  EXPECT_EQ(server.hear(sent).size(), sent);
}

TEST_F(TcpTest, SaysWhatToTryWhereNothingLeads) {
  Opened<Tcp> nowhere = Tcp::open({"255.255.255.255", 1});
  ASSERT_FALSE(nowhere.ok());
  EXPECT_NE(nowhere.problem().find("255.255.255.255:1"), std::string::npos) << nowhere.problem();
  EXPECT_NE(nowhere.problem().find("see whether 'ping' gets there"), std::string::npos) << nowhere.problem();
  Opened<Tcp> no_scope = Tcp::open({"fe80::1", 1});  // which of the links?
  ASSERT_FALSE(no_scope.ok());
  EXPECT_NE(no_scope.problem().find("check host and port"), std::string::npos) << no_scope.problem();
}

TEST_F(TcpTest, TellsOfAResetOnWriting) {
  Opened<Tcp> tcp = Tcp::open({"127.0.0.1", server.port()});
  ASSERT_TRUE(tcp) << tcp.problem();
  server.accept();
  server.reset();
  EXPECT_EQ(tcp->write({}).value(), 0U) << "nothing was tried";
  EXPECT_EQ(tcp->read({}).value(), 0U);
  EXPECT_EQ(tcp->write(octets("x")).error(), Error::kGone);
  EXPECT_FALSE(tcp->connected());
}

// A listener whose queue is full answers nothing, as a host that is switched off.
TEST_F(TcpTest, WaitsTwoSecondsOfItsClockForAnAnswer) {
  std::vector<Tcp> queue;
  const Time start = Time{} + milliseconds(1000);
  while (queue.size() < 8 && (queue.empty() || queue.back().connected())) {
    Opened<Tcp> tcp = Tcp::later({"127.0.0.1", server.port()});
    ASSERT_TRUE(tcp) << tcp.problem();
    queue.push_back(std::move(*tcp));
    queue.back().tend(start);
  }
  Tcp& waiting = queue.back();
  ASSERT_FALSE(waiting.connected());
  waiting.tend(start + milliseconds(2000));
  EXPECT_EQ(waiting.problem(), "");
  waiting.tend(start + milliseconds(2000) + base::Duration{1});
  EXPECT_FALSE(waiting.connected());
  EXPECT_NE(waiting.problem().find("see whether 'ping' gets there"), std::string::npos) << waiting.problem();
}

}  // namespace
}  // namespace fencepost::linux
