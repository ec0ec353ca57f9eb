#include "drivers/wire/flush.hpp"

#include <gtest/gtest.h>

#include <array>

#include "hal/fake/scripted_link.hpp"

namespace fencepost::wire {
namespace {

constexpr std::array<std::uint8_t, 3> kBytes = {1, 2, 3};

TEST(Flush, SendsTheRestLater) {
  fake::ScriptedLink<8> link({});
  serial::Outbox<4> outbox;
  EXPECT_TRUE(flush(outbox, link));
  replace(outbox, kBytes);
  link.limit_writes(2);
  EXPECT_TRUE(flush(outbox, link));
  EXPECT_EQ(outbox.waiting().size(), 1U);
  link.limit_writes(0);
  EXPECT_TRUE(flush(outbox, link));
  EXPECT_EQ(outbox.waiting().size(), 1U);
  link.limit_writes(2);
  EXPECT_TRUE(flush(outbox, link));
  EXPECT_TRUE(outbox.waiting().empty());
  ASSERT_EQ(link.written().size(), 3U);
  EXPECT_EQ(link.written()[2], 3);
}

TEST(Flush, ReplacesTheRestOfTheLastRequest) {
  fake::ScriptedLink<8> link({});
  serial::Outbox<4> outbox;
  replace(outbox, kBytes);
  link.limit_writes(1);
  EXPECT_TRUE(flush(outbox, link));
  replace(outbox, kBytes);
  EXPECT_EQ(outbox.waiting().size(), 3U);
}

TEST(Flush, SaysThatTheLinkIsGone) {
  fake::ScriptedLink<8> link({});
  link.unplug();
  serial::Outbox<4> outbox;
  EXPECT_TRUE(flush(outbox, link));
  replace(outbox, kBytes);
  EXPECT_FALSE(flush(outbox, link));
}

}  // namespace
}  // namespace fencepost::wire
