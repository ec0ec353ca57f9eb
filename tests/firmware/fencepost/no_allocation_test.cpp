// The library asks for no memory, its construction included: every way to the heap is trapped.
#include <gtest/gtest.h>

#include "tests/firmware/fencepost/played_log.hpp"
#include "tests/firmware/trapped_heap.hpp"

namespace fencepost::test {
namespace {

// The inputs of the player above ask for none either, but for names, which are shorter than what a string holds in
// place.
TEST(LibraryNoAllocation, FromItsConstructionOn) {
  const std::string bytes = bundled("noisy_arc.log");
  int alerts = 0;
  arm();
  static SmallCore core;
  core.on_alert([](void* context, const Alert& /*alert*/) { ++*static_cast<int*>(context); }, &alerts);
  const auto played = play(core, bytes);
  core.step(played.last + 5'000'000);
  std::array<Object, Small::kObjects> objects{};
  const std::size_t count = core.objects(objects.data(), objects.size());
  std::array<Point, kMaxCorners> corners{};
  const std::size_t size = core.outline(objects[0].id, corners.data(), corners.size());
  EXPECT_EQ(disarm(), 0U);
  EXPECT_EQ(played.refused, 0);
  EXPECT_GT(alerts, 0);
  EXPECT_EQ(count, 3U);
  EXPECT_GE(size, 3U);
}

}  // namespace
}  // namespace fencepost::test
