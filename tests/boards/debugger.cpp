#include "tests/boards/debugger.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>

#include "tests/boards/bench.hpp"

namespace fencepost::test {
namespace {

// One line more, which is the debugger's.
BoardUnderTest with_debugger(BoardUnderTest board) {
  board.command = [plain = board.command](std::vector<std::string> sockets) {
    const std::string last = sockets.back();
    sockets.pop_back();
    std::vector<std::string> words = plain(sockets);
    words.insert(words.end(), {"-chardev", "socket,id=debugger,path=" + last, "-gdb", "chardev:debugger"});
    return words;
  };
  ++board.lines;
  return board;
}

// Packets of GDB's remote protocol (its manual, appendix E), and time to answer each.
class Debugger {
 public:
  Debugger(Bench& bench, std::size_t line) : bench_(bench), line_(line) {
    tell("?");
    tell("qXfer:features:read:target.xml:0,ffb");
    go_on();
  }
  void go_on() { tell("c"); }
  void interrupt() { send("\x03"); }
  void tell(const std::string& packet) {
    unsigned sum = 0;
    for (const char c : packet) sum += static_cast<unsigned char>(c);
    std::array<char, 4> check{};
    std::snprintf(check.data(), check.size(), "#%02x", sum & 0xFFU);
    send("+$" + packet + check.data());
  }

 private:
  void send(const std::string& bytes) {
    bench_.line(line_).send(bytes);
    bench_.run(0.3);
  }

  Bench& bench_;
  std::size_t line_;
};

}  // namespace

void expect_tells_of_a_fault(const BoardUnderTest& board, const std::string& from) {
  Bench bench(with_debugger(board));
  Debugger debugger(bench, board.lines);
  ASSERT_TRUE(bench.await("READY\r\n")) << bench.said();
  EXPECT_NE(bench.said().find("panic: none"), std::string::npos) << bench.said();
  bench.clear();
  debugger.interrupt();
  debugger.tell("Pf=01000030");  // the program counter, least byte first
  debugger.go_on();
  ASSERT_TRUE(bench.await("READY\r\n")) << bench.line(board.lines).take();
  EXPECT_NE(bench.said().find("reset: panic\r\npanic: exception 3 at 30000000, " + from), std::string::npos)
      << bench.said();
  EXPECT_TRUE(bench.obey("version", "fencepost "));
}

}  // namespace fencepost::test
