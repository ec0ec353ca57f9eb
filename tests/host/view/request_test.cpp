#include "host/view/request.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <random>

namespace fencepost::host {
namespace {

using What = Judgement::What;

std::string head(const std::string& request, const std::string& more = {}) {
  return request + "\r\nHost: 127.0.0.1:4321" + more;
}

TEST(Judge, GivesThePageAndTheStream) {
  EXPECT_EQ(judge(head("GET / HTTP/1.1")).what, What::kPage);
  EXPECT_EQ(judge(head("GET /log HTTP/1.1")).what, What::kStream);
  EXPECT_EQ(judge(head("GET / HTTP/1.1", "\r\nUser-Agent: any\r\nAccept: */*")).what, What::kPage);
}

TEST(Judge, KnowsTheNamesOfThisMachine) {
  for (const char* host :
       {"127.0.0.1", "localhost", "localhost:80", "LocalHost:8080", "[::1]:9000", "\t127.0.0.1:1 "}) {
    EXPECT_EQ(judge("GET /log HTTP/1.1\r\nhost:" + std::string(host)).status, 200) << host;
  }
  for (const char* host : {"", "evil.example", "evil.example:4321", "127.0.0.1.evil.example",
                           "localhost.evil.example:80", "localhost:", "localhost:80x", "127.0.0.1@evil.example",
                           "0.0.0.0", "127.0.0.2", "[::2]", "localhost, evil.example"}) {
    EXPECT_EQ(judge("GET / HTTP/1.1\r\nHost: " + std::string(host)).status, 403) << host;
  }
}

TEST(Judge, WantsOneHost) {
  EXPECT_EQ(judge("GET / HTTP/1.1").status, 400);
  EXPECT_EQ(judge("GET / HTTP/1.1\r\nAccept: */*").status, 400);
  EXPECT_EQ(judge(head("GET / HTTP/1.1", "\r\nHost: evil.example")).status, 400);
}

TEST(Judge, AnswersNoOtherOrigin) {
  EXPECT_EQ(judge(head("GET /log HTTP/1.1", "\r\nOrigin: http://127.0.0.1:4321")).status, 200);
  for (const char* origin : {"http://evil.example", "null", "https://127.0.0.1:4321", "http://127.0.0.1:4322",
                             "http://localhost:4321", ""}) {
    EXPECT_EQ(judge(head("GET /log HTTP/1.1", "\r\nOrigin: " + std::string(origin))).status, 403) << origin;
    EXPECT_EQ(judge(head("GET / HTTP/1.1", "\r\nOrigin: " + std::string(origin))).status, 403) << origin;
  }
  for (const char* site : {"same-origin", "none"}) {
    EXPECT_EQ(judge(head("GET /log HTTP/1.1", "\r\nSec-Fetch-Site: " + std::string(site))).status, 200) << site;
  }
  for (const char* site : {"cross-site", "same-site", "other"}) {
    EXPECT_EQ(judge(head("GET /log HTTP/1.1", "\r\nSec-Fetch-Site: " + std::string(site))).status, 403) << site;
    // A link to the page may be followed from anywhere.
    EXPECT_EQ(judge(head("GET / HTTP/1.1", "\r\nSec-Fetch-Site: " + std::string(site))).status, 200) << site;
  }
}

TEST(Judge, OnlyGetsOnlyTheseTwo) {
  for (const char* method : {"POST", "HEAD", "OPTIONS", "PUT", "DELETE", "get", "CONNECT", ""}) {
    EXPECT_EQ(judge(head(std::string(method) + " / HTTP/1.1")).status, 405) << method;
  }
  for (const char* target : {"/x", "//", "/../etc/passwd", "/log/", "/?", "/log?x", "*", "http://127.0.0.1:4321/",
                             "/%2e%2e/", "/index.html", "/favicon.ico", "/ /"}) {
    EXPECT_EQ(judge(head("GET " + std::string(target) + " HTTP/1.1")).status, 404) << target;
  }
  for (const char* version : {"HTTP/1.0", "HTTP/2.0", "HTTP/1.10", "http/1.1", "x"}) {
    EXPECT_EQ(judge(head("GET / " + std::string(version))).status, 505) << version;
  }
}

TEST(Judge, RefusesWhatIsNoRequest) {
  const std::string strange[] = {"",
                                 "GET",
                                 "GET /",
                                 "GET HTTP/1.1",
                                 "\x16\x03\x01",
                                 std::string("GET / HTTP/1.1\0", 15),
                                 head("GET / HTTP/1.1", "\r\nno header"),
                                 head("GET / HTTP/1.1", "\r\n: empty"),
                                 head("GET / HTTP/1.1", "\r\n folded: line"),
                                 head("GET / HTTP/1.1", "\r\nA : b"),
                                 head("GET / HTTP/1.1", "\nHost: evil.example"),
                                 head("GET / HTTP/1.1", "\rA: b"),
                                 head("GET / HTTP/1.1", "\r\nContent-Length: 5"),
                                 head("GET / HTTP/1.1", "\r\nTransfer-Encoding: chunked")};
  for (const std::string& request : strange) EXPECT_NE(judge(request).status, 200) << request;
  EXPECT_EQ(judge(head("GET / HTTP/1.1", "\r\nContent-Length: 0")).status, 200);
}

// Requests that are good but for a few bytes, and noise.
TEST(Judge, NeverCrashesAndLetsNothingElseThrough) {
  std::mt19937 random(20'261'123);
  const std::string good[] = {head("GET / HTTP/1.1"), head("GET /log HTTP/1.1", "\r\nOrigin: http://127.0.0.1:4321"),
                              "GET /log HTTP/1.1\r\nHost: localhost:80\r\nSec-Fetch-Site: same-origin"};
  const std::string spice = std::string("\r\n \t:\0/.@%,[]", 14) + "GETHOSTlog10\x80\xff";
  std::size_t through = 0;
  for (int i = 0; i < 200'000; ++i) {
    std::string request = good[random() % 3];
    for (std::size_t k = random() % 4; k > 0; --k) {
      const std::size_t at = random() % request.size();
      const char byte = spice[random() % spice.size()];
      if (random() % 2 == 0) {
        request[at] = byte;
      } else {
        request.insert(at, 1, byte);
      }
    }
    if (judge(request).status != 200) continue;
    ++through;
    const std::string first = request.substr(0, request.find("\r\n"));
    EXPECT_TRUE(first == "GET / HTTP/1.1" || first == "GET /log HTTP/1.1") << request;
    std::string lower = request;
    std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return std::tolower(c); });
    const auto names = {"127.0.0.1", "localhost", "[::1]"};
    EXPECT_TRUE(std::ranges::any_of(names, [&](const char* name) { return lower.find(name) != std::string::npos; }))
        << request;
  }
  EXPECT_GT(through, 1000U);
}

TEST(AnswerHead, EndsWithAnEmptyLineAndForbidsOthers) {
  const std::string text = answer_head(403, "text/plain", "Content-Length: 5\r\n");
  EXPECT_TRUE(text.starts_with("HTTP/1.1 403 "));
  EXPECT_TRUE(text.ends_with("\r\nContent-Length: 5\r\n\r\n"));
  EXPECT_NE(text.find("\r\nX-Content-Type-Options: nosniff\r\n"), std::string::npos);
  EXPECT_NE(text.find("frame-ancestors 'none'"), std::string::npos);
  EXPECT_EQ(text.find("Access-Control"), std::string::npos);
}

}  // namespace
}  // namespace fencepost::host
