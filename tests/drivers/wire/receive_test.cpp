#include "drivers/wire/receive.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

#include "hal/fake/scripted_link.hpp"

namespace fencepost::wire {
namespace {

using Bytes = std::vector<std::uint8_t>;

struct Received {
  bool found = false;
  Bytes bytes;
  int chunks = 0;
};

template <class Link>
Received received(Link& link, int reads) {
  Received all;
  all.found = receive(link, reads, [&](std::span<const std::uint8_t> chunk) {
    all.bytes.insert(all.bytes.end(), chunk.begin(), chunk.end());
    ++all.chunks;
  });
  return all;
}

TEST(Receive, TakesWhatIsThereAndNoMoreReadsThanAllowed) {
  Bytes long_one(100);
  for (std::size_t i = 0; i < long_one.size(); ++i) long_one[i] = static_cast<std::uint8_t>(i);
  const std::array<fake::LinkStep, 1> script = {{{long_one, {}}}};
  fake::ScriptedLink<8> link(script);
  const Received first = received(link, 2);
  EXPECT_TRUE(first.found);
  EXPECT_EQ(first.bytes, Bytes(long_one.begin(), long_one.begin() + 64));
  const Received rest = received(link, 8);
  EXPECT_TRUE(rest.found);
  EXPECT_EQ(rest.bytes, Bytes(long_one.begin() + 64, long_one.end()));
  EXPECT_EQ(rest.chunks, 2);
}

TEST(Receive, EndsWhereNothingMoreHasCome) {
  const Bytes one = {1};
  const Bytes two = {2};
  const std::array<fake::LinkStep, 3> script = {{{one, {}}, {{}, base::Error::kNotReady}, {two, {}}}};
  fake::ScriptedLink<8> link(script);
  EXPECT_EQ(received(link, 8).bytes, one);
  EXPECT_EQ(received(link, 8).bytes, two);
  const Received nothing = received(link, 8);
  EXPECT_TRUE(nothing.found);
  EXPECT_EQ(nothing.chunks, 0);
}

// Faults of the line are no reason to give it up.
TEST(Receive, SaysThatTheLinkIsGoneAndOnlyThen) {
  const Bytes one = {1};
  const std::array<fake::LinkStep, 3> script = {{{{}, base::Error::kBadInput}, {one, {}}, {{}, base::Error::kGone}}};
  fake::ScriptedLink<8> link(script);
  EXPECT_TRUE(received(link, 8).found);
  const Received last = received(link, 8);
  EXPECT_FALSE(last.found);
  EXPECT_EQ(last.bytes, one);
}

}  // namespace
}  // namespace fencepost::wire
