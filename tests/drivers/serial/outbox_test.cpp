#include "drivers/serial/outbox.hpp"

#include <gtest/gtest.h>

#include <string>

namespace fencepost::serial {
namespace {

template <std::size_t N>
std::string waiting(const Outbox<N>& outbox) {
  return {outbox.waiting().begin(), outbox.waiting().end()};
}

TEST(Outbox, GoesOutInPieces) {
  Outbox<8> outbox;
  EXPECT_TRUE(outbox.put("abc"));
  EXPECT_TRUE(outbox.put("de"));
  outbox.sent(2);
  EXPECT_EQ(waiting(outbox), "cde");
  outbox.sent(3);
  EXPECT_EQ(waiting(outbox), "");
  EXPECT_TRUE(outbox.put("12345678")) << "all room is free again";
}

TEST(Outbox, TakesAllOrNothing) {
  Outbox<4> outbox;
  EXPECT_TRUE(outbox.put("abc"));
  EXPECT_FALSE(outbox.put("de"));
  EXPECT_EQ(waiting(outbox), "abc");
  constexpr std::uint8_t kBytes[] = {1, 2};
  EXPECT_FALSE(outbox.put(kBytes));
  outbox.clear();
  EXPECT_TRUE(outbox.put(kBytes));
}

}  // namespace
}  // namespace fencepost::serial
