#include "drivers/wire/outbox.hpp"

#include <gtest/gtest.h>

#include <array>

#include "hal/fake/scripted_link.hpp"

namespace fencepost::wire {
namespace {

Outbox<4>::Bytes three() {
  Outbox<4>::Bytes bytes;
  for (const std::uint8_t byte : std::array<std::uint8_t, 3>{1, 2, 3}) EXPECT_TRUE(bytes.push_back(byte));
  return bytes;
}

TEST(Outbox, SendsTheRestLater) {
  fake::ScriptedLink<8> link({});
  Outbox<4> outbox;
  EXPECT_TRUE(outbox.empty());
  outbox.put(three());
  link.limit_writes(2);
  EXPECT_TRUE(outbox.flush(link));
  EXPECT_FALSE(outbox.empty());
  link.limit_writes(0);
  EXPECT_TRUE(outbox.flush(link));
  EXPECT_FALSE(outbox.empty());
  link.limit_writes(2);
  EXPECT_TRUE(outbox.flush(link));
  EXPECT_TRUE(outbox.empty());
  ASSERT_EQ(link.written().size(), 3U);
  EXPECT_EQ(link.written()[2], 3);
}

TEST(Outbox, SaysThatTheLinkIsGone) {
  fake::ScriptedLink<8> link({});
  link.unplug();
  Outbox<4> outbox;
  EXPECT_TRUE(outbox.flush(link));
  outbox.put(three());
  EXPECT_FALSE(outbox.flush(link));
  outbox.clear();
  EXPECT_TRUE(outbox.empty());
}

}  // namespace
}  // namespace fencepost::wire
