// Browsers come, ask strange things, read slowly and go; the run goes on.
#include "host/view/view_server.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <string>

namespace fencepost::host {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds kDeadline{20'000};  ///< only a failing test reaches it

sockaddr_in address_of(const std::string& host, const std::string& page) {
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<std::uint16_t>(std::stoi(page.substr(page.rfind(':') + 1))));
  ::inet_pton(AF_INET, host.c_str(), &to.sin_addr);
  return to;
}

/// Somebody who connects.
class Browser {
 public:
  explicit Browser(const ViewServer& server, int receive_buffer = 0)
      : fd_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    if (receive_buffer > 0) ::setsockopt(fd_.get(), SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
    sockaddr_in to = address_of("127.0.0.1", server.address());
    EXPECT_EQ(::connect(fd_.get(), static_cast<sockaddr*>(static_cast<void*>(&to)), sizeof to), 0);
  }
  void say(const std::string& text) const {
    EXPECT_EQ(::send(fd_.get(), text.data(), text.size(), MSG_NOSIGNAL), ssize_t(text.size()));
  }
  void ask(const std::string& path) const { say("GET " + path + " HTTP/1.1\r\nHost: localhost\r\n\r\n"); }
  /// Until `enough` has come, or the other end has hung up: then "<end>" or, cut off, "<broken>" follows.
  std::string read(const std::string& enough = "<never>") {
    const auto end = steady_clock::now() + kDeadline;
    while (steady_clock::now() < end) {
      if (text_.find(enough, searched_) != std::string::npos) break;
      searched_ = text_.size() - std::min(text_.size(), enough.size());
      pollfd wait{fd_.get(), POLLIN, 0};
      ::poll(&wait, 1, 100);
      std::array<char, 65536> buffer{};
      const ssize_t count = ::recv(fd_.get(), buffer.data(), buffer.size(), MSG_DONTWAIT);
      if (count > 0) text_.append(buffer.data(), static_cast<std::size_t>(count));
      if (count == 0) return text_ + "<end>";
      if (count < 0 && errno != EAGAIN) return text_ + "<broken>";
    }
    return text_;
  }
  void leave() { fd_.close(); }

 private:
  linux::Descriptor fd_;
  std::string text_;
  std::size_t searched_ = 0;
};

/// The text that was sent in chunks; "<unfinished>" behind it without the last one.
std::string unchunked(const std::string& answer) {
  std::size_t at = answer.find("\r\n\r\n") + 4;
  std::string text;
  while (at < answer.size() && answer[at] != '<') {
    const std::size_t size = std::stoul(answer.substr(at), nullptr, 16);
    at = answer.find("\r\n", at) + 2;
    if (size == 0) return text;
    text += answer.substr(at, size);
    at += size + 2;
  }
  return text + "<unfinished>";
}

std::unique_ptr<ViewServer> server_of(std::string page = "<p>page</p>", std::size_t capacity = 1 << 20) {
  ViewServer::Opened opened = ViewServer::open(std::move(page), 0, capacity);
  EXPECT_TRUE(opened.ok());
  return std::move(*opened);
}

struct ViewServerTest : testing::Test {
  std::unique_ptr<ViewServer> server = server_of();
};

TEST_F(ViewServerTest, GivesThePage) {
  Browser browser(*server);
  browser.ask("/");
  const std::string answer = browser.read();
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 200 OK\r\n")) << answer;
  EXPECT_NE(answer.find("\r\nContent-Type: text/html; charset=utf-8\r\n"), std::string::npos);
  EXPECT_NE(answer.find("\r\nContent-Length: 11\r\n"), std::string::npos);
  EXPECT_TRUE(answer.ends_with("\r\n\r\n<p>page</p><end>")) << answer;
}

TEST_F(ViewServerTest, GivesALargePageWhole) {
  const std::string page(3 << 20, 'p');
  server = server_of(page);
  Browser browser(*server, 4096);
  browser.ask("/");
  const std::string answer = browser.read();
  EXPECT_TRUE(answer.ends_with(page + "<end>"));
}

TEST_F(ViewServerTest, IsOnThisMachineAlone) {
  EXPECT_TRUE(server->address().starts_with("http://127.0.0.1:")) << server->address();
  // Another address of this machine's loopback: a server on all addresses would be there.
  const linux::Descriptor fd(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  sockaddr_in to = address_of("127.0.0.2", server->address());
  EXPECT_NE(::connect(fd.get(), static_cast<sockaddr*>(static_cast<void*>(&to)), sizeof to), 0);
}

TEST_F(ViewServerTest, SaysWhenThePortIsTaken) {
  const std::string address = server->address();
  const auto port = static_cast<std::uint16_t>(std::stoi(address.substr(address.rfind(':') + 1)));
  const ViewServer::Opened second = ViewServer::open("", port);
  ASSERT_FALSE(second.ok());
  EXPECT_NE(second.problem().find("127.0.0.1:" + std::to_string(port) + ": Address already in use"), std::string::npos)
      << second.problem();
}

TEST_F(ViewServerTest, RefusesBadRequestsAndGoesOn) {
  const std::pair<std::string, int> strange[] = {
      {"POST / HTTP/1.1\r\nHost: localhost\r\n\r\n", 405},
      {"GET /secret HTTP/1.1\r\nHost: localhost\r\n\r\n", 404},
      {"GET / HTTP/1.1\r\nHost: evil.example\r\n\r\n", 403},
      {"GET /log HTTP/1.1\r\nHost: localhost\r\nOrigin: http://evil.example\r\n\r\n", 403},
      {"\r\n\r\n", 400},
      {"GET / HTTP/1.0\r\n\r\n", 505},
      {"GET / HTTP/1.1\r\nHost: localhost\r\nX: " + std::string(9000, 'x') + "\r\n\r\n", 431},
      {std::string(20'000, 'x'), 431},
  };
  for (const auto& [request, status] : strange) {
    Browser browser(*server);
    browser.say(request);
    const std::string answer = browser.read();
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 " + std::to_string(status) + " ")) << request.substr(0, 60) << answer;
    EXPECT_TRUE(answer.ends_with("<end>")) << answer;
    EXPECT_EQ(answer.find("Access-Control"), std::string::npos);
  }
  Browser browser(*server);
  browser.ask("/");
  EXPECT_TRUE(browser.read().ends_with("<p>page</p><end>"));
}

TEST_F(ViewServerTest, TakesARequestInPieces) {
  Browser browser(*server);
  for (const char c : std::string("GET / HTTP/1.1\r\nHost: localhost\r\n\r\n")) {
    browser.say(std::string(1, c));
    ::poll(nullptr, 0, 1);
  }
  EXPECT_TRUE(browser.read().ends_with("<p>page</p><end>"));
}

TEST_F(ViewServerTest, StreamsTheLogFromItsFirstLineToSeveral) {
  server->add("$FPHDR,1\n");
  Browser first(*server);
  first.ask("/log");
  EXPECT_NE(first.read("$FPHDR,1\n").find("Transfer-Encoding: chunked"), std::string::npos);
  server->add("one\n");
  EXPECT_NE(first.read("one\n").find("one\n"), std::string::npos);
  Browser second(*server);
  second.ask("/log");
  EXPECT_EQ(unchunked(second.read("one\n")), "$FPHDR,1\none\n<unfinished>");
  server->add("two\n");
  server->finish(kDeadline);
  EXPECT_EQ(unchunked(first.read()), "$FPHDR,1\none\ntwo\n");
  EXPECT_EQ(unchunked(second.read()), "$FPHDR,1\none\ntwo\n");
}

// The loop's side: the cost of adding lines while nobody reads, a slow reader does, or one that has stopped.
TEST_F(ViewServerTest, ASlowReaderIsLeftBehindAndNobodyWaits) {
  server = server_of("", 2 << 20);
  Browser slow(*server, 32 << 10);
  slow.ask("/log");
  server->add("$FPHDR,1\n");
  EXPECT_NE(slow.read("$FPHDR,1\n").find("$FPHDR,1\n"), std::string::npos);
  Browser quick(*server);
  quick.ask("/log");
  const std::string line = std::string(99, 'x') + "\n";
  auto longest = steady_clock::duration::zero();
  for (int i = 0; i < 30; ++i) {
    const auto before = steady_clock::now();
    for (int k = 0; k < 8000; ++k) server->add(line);
    longest = std::max(longest, steady_clock::now() - before);
    const std::string mark = "mark " + std::to_string(i) + "\n";
    server->add(mark);
    ASSERT_NE(quick.read(mark).find(mark), std::string::npos) << i;
  }
  EXPECT_LT(longest, milliseconds(1000));
  const std::string left_behind = unchunked(slow.read());
  EXPECT_TRUE(left_behind.ends_with("<unfinished>"));
  EXPECT_EQ(left_behind.find("mark 29\n"), std::string::npos);
  server->finish(kDeadline);
  const std::string whole = unchunked(quick.read());
  EXPECT_EQ(whole.find("<unfinished>"), std::string::npos);
  EXPECT_EQ(std::ranges::count(whole, '\n'), 1 + 30 * 8001);
}

TEST_F(ViewServerTest, EndsWhileSomebodyDoesNotRead) {
  server = server_of("", 64 << 20);
  Browser stuck(*server, 4096);
  stuck.ask("/log");
  server->add("$FPHDR,1\n");
  stuck.read("$FPHDR,1\n");
  const std::string line = std::string(999, 'x') + "\n";
  for (int i = 0; i < 32 << 10; ++i) server->add(line);
  Browser ahead(*server);  // connected, and asks for nothing
  const auto before = steady_clock::now();
  server->finish(milliseconds(300));
  const auto took = steady_clock::now() - before;
  EXPECT_GE(took, milliseconds(300));
  EXPECT_LT(took, kDeadline);
}

TEST_F(ViewServerTest, OneThatHasGoneIsNotMissed) {
  for (int i = 0; i < 100; ++i) {  // more than there are places
    Browser browser(*server);
    browser.ask("/log");
    server->add("line\n");
    browser.read("line\n");
    browser.leave();
  }
  Browser browser(*server);
  browser.ask("/");
  EXPECT_TRUE(browser.read().ends_with("<p>page</p><end>"));
}

TEST_F(ViewServerTest, HasPlacesForSoMany) {
  server->add("line\n");
  std::vector<Browser> all;
  for (std::size_t i = 0; i < ViewServer::kMaxVisitors; ++i) {
    all.emplace_back(*server);
    all.back().ask("/log");
    EXPECT_NE(all.back().read("line\n").find("line\n"), std::string::npos) << i;
  }
  // Its request is read: hung up on before, it could lose the answer.
  Browser more(*server);
  more.ask("/log");
  const std::string refused = more.read();
  EXPECT_TRUE(refused.starts_with("HTTP/1.1 503 ")) << refused;
  EXPECT_TRUE(refused.ends_with("too many browsers show this run; close one of them, and load this page again\n<end>"))
      << refused;
  server->add("next\n");
  for (Browser& browser : all) EXPECT_NE(browser.read("next\n").find("next\n"), std::string::npos);
}

}  // namespace
}  // namespace fencepost::host
