// Lines that wait for a link: each whole or not at all, in order, whatever the link takes.
#include "firmware/loop/output_queue.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace fencepost::test {
namespace {

using Queue = loop::OutputQueue<record::kMaxLine>;

bool put(Queue& queue, const std::string& line) {
  return queue.put_line([&](std::span<char> room) {
    if (line.size() > room.size()) return std::size_t{0};
    std::copy(line.begin(), line.end(), room.begin());
    return line.size();
  });
}
std::string waiting(const Queue& queue) { return {queue.waiting().begin(), queue.waiting().end()}; }

TEST(OutputQueue, KeepsLinesInTheirOrder) {
  Queue queue;
  EXPECT_EQ(waiting(queue), "");
  EXPECT_TRUE(put(queue, "first\n"));
  queue.taken(2);
  EXPECT_TRUE(put(queue, "second\n"));
  EXPECT_EQ(waiting(queue), "rst\nsecond\n");
  queue.taken(4);
  EXPECT_TRUE(put(queue, "third\n"));
  EXPECT_EQ(waiting(queue), "second\nthird\n");
  queue.taken(13);
  EXPECT_EQ(waiting(queue), "");
}

TEST(OutputQueue, WhatWasTakenMakesRoom) {
  Queue queue;
  const std::string most(record::kMaxLine - 10, 'a');
  EXPECT_TRUE(put(queue, most));
  EXPECT_FALSE(put(queue, std::string(11, 'b')));
  EXPECT_TRUE(put(queue, std::string(10, 'b'))) << "to its last byte";
  EXPECT_FALSE(put(queue, "c"));
  queue.taken(1);
  EXPECT_FALSE(put(queue, "cc"));
  EXPECT_TRUE(put(queue, "c"));
  EXPECT_EQ(waiting(queue), most.substr(1) + std::string(10, 'b') + "c");
  queue.taken(record::kMaxLine);
  EXPECT_TRUE(put(queue, std::string(record::kMaxLine, 'd')));
  EXPECT_EQ(waiting(queue), std::string(record::kMaxLine, 'd'));
}

// A line that fits is written once, where it stays.
TEST(OutputQueue, ALineIsWrittenAgainOnlyWhereItDidNotFit) {
  Queue queue;
  int writes = 0;
  const auto write = [&](std::size_t size) {
    return queue.put_line([&](std::span<char> room) {
      ++writes;
      if (size > room.size()) return std::size_t{0};
      std::fill_n(room.begin(), size, 'x');
      return size;
    });
  };
  EXPECT_TRUE(write(100));
  queue.taken(50);
  EXPECT_TRUE(write(100));
  EXPECT_EQ(writes, 2);
  EXPECT_FALSE(write(record::kMaxLine));
  EXPECT_EQ(writes, 4) << "the second time at the front";
  EXPECT_EQ(queue.waiting().size(), 150U);
}

}  // namespace
}  // namespace fencepost::test
