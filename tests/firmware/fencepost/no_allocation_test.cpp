// The library asks for no memory, its construction included: every way to the heap is trapped.
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "tests/firmware/fencepost/played_log.hpp"

namespace {

bool g_armed = false;
std::size_t g_requests = 0;

}  // namespace

extern "C" {
void* __real_malloc(std::size_t size);
void* __wrap_malloc(std::size_t size) {
  g_requests += g_armed ? 1 : 0;
  return __real_malloc(size);
}
}
void* operator new(std::size_t size) {
  g_requests += g_armed ? 1 : 0;
  if (void* memory = __real_malloc(size)) return memory;
  throw std::bad_alloc();
}
// Not inlined, or the compiler thinks that free() meets memory of another allocator.
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace fencepost::test {
namespace {

// The inputs of the player above ask for none either, but for names, which are shorter than what a string holds in
// place.
TEST(LibraryNoAllocation, FromItsConstructionOn) {
  const std::string bytes = bundled("noisy_arc.log");
  int alerts = 0;
  g_requests = 0;
  g_armed = true;
  static SmallCore core;
  core.on_alert([](void* context, const Alert& /*alert*/) { ++*static_cast<int*>(context); }, &alerts);
  const auto played = play(core, bytes);
  core.step(played.last + 5'000'000);
  std::array<Object, Small::kObjects> objects{};
  const std::size_t count = core.objects(objects.data(), objects.size());
  std::array<Point, kMaxCorners> corners{};
  const std::size_t size = core.outline(objects[0].id, corners.data(), corners.size());
  g_armed = false;
  EXPECT_EQ(g_requests, 0U);
  EXPECT_EQ(played.refused, 0);
  EXPECT_GT(alerts, 0);
  EXPECT_EQ(count, 3U);
  EXPECT_GE(size, 3U);
}

TEST(LibraryNoAllocation, TheTrapCatchesNewAndMalloc) {
  g_requests = 0;
  g_armed = true;
  auto* one = new int(10);
  void* volatile two = std::malloc(10);
  g_armed = false;
  EXPECT_EQ(g_requests, 2U);
  std::free(two);
  delete one;
}

}  // namespace
}  // namespace fencepost::test
