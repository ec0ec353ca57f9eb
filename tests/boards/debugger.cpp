#include "tests/boards/debugger.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>

#include "tests/boards/bench.hpp"

namespace fencepost::test {
namespace {

constexpr std::uint32_t kNowhere = 0x30000000;

std::string least_byte_first(std::uint32_t word) {
  std::array<char, 12> text{};
  std::snprintf(text.data(), text.size(), "%08x", __builtin_bswap32(word));
  return text.data();
}

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
  board.may_stop = true;
  return board;
}

// Packets of GDB's remote protocol (its manual, appendix E).
class Debugger {
 public:
  Debugger(Bench& bench, std::size_t line) : bench_(bench), line_(line) {
    ask("?");
    ask("qXfer:features:read:target.xml:0,ffb");
    go_on();
  }
  void go_on() { send(packet("c")); }
  void interrupt() {
    send("\x03");
    await_answer();
  }
  void ask(const std::string& words) {
    send(packet(words));
    await_answer();
  }

 private:
  static std::string packet(const std::string& words) {
    unsigned sum = 0;
    for (const char c : words) sum += static_cast<unsigned char>(c);
    std::array<char, 4> check{};
    std::snprintf(check.data(), check.size(), "#%02x", sum & 0xFFU);
    return "+$" + words + check.data();
  }
  void send(const std::string& bytes) {
    heard_.clear();
    bench_.line(line_).send(bytes);
    bench_.pump();
  }
  // `$...#` and two digits.
  void await_answer() {
    for (const double start = bench_.seconds(); bench_.seconds() - start < kPatience; bench_.pump()) {
      heard_ += bench_.line(line_).take();
      const std::size_t end = heard_.find('#', heard_.find('$'));
      if (end != std::string::npos && heard_.size() >= end + 3) return;
    }
    ADD_FAILURE() << "the debugger was not answered: " << heard_;
  }

  static constexpr double kPatience = 20;  // s
  Bench& bench_;
  std::size_t line_;
  std::string heard_;
};

}  // namespace

void expect_tells_of_a_fault(const BoardUnderTest& board, std::uint32_t caller) {
  Bench bench(with_debugger(board));
  Debugger debugger(bench, board.lines);
  ASSERT_TRUE(bench.await("READY\r\n")) << bench.said();
  EXPECT_NE(bench.said().find("panic: none"), std::string::npos) << bench.said();
  bench.clear();
  debugger.interrupt();
  debugger.ask("Pe=" + least_byte_first(caller));  // the link register: it may be in an interrupt, which nobody calls
  debugger.ask("Pf=" + least_byte_first(kNowhere | 1));
  debugger.go_on();
  ASSERT_TRUE(bench.await("READY\r\n")) << bench.line(board.lines).take();
  std::array<char, 100> expected{};
  std::snprintf(expected.data(), expected.size(), "reset: panic\r\npanic: exception 3 at %08x, called from %08x\r\n",
                kNowhere, caller);
  EXPECT_NE(bench.said().find(expected.data()), std::string::npos) << bench.said();
  EXPECT_TRUE(bench.obey("version", "fencepost "));
}

}  // namespace fencepost::test
