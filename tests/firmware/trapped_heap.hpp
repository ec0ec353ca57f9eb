// Every way to the heap is trapped and counted. Belongs to one source of a program that is linked with --wrap=malloc,
// calloc and realloc.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <new>
#include <vector>

namespace fencepost::test {

inline bool g_armed = false;
inline std::size_t g_requests = 0;

inline void note() { g_requests += g_armed ? 1 : 0; }

inline void arm() {
  g_requests = 0;
  g_armed = true;
}
/// How often memory was asked for since then.
inline std::size_t disarm() {
  g_armed = false;
  return g_requests;
}

}  // namespace fencepost::test

extern "C" {
void* __real_malloc(std::size_t size);
void* __real_calloc(std::size_t count, std::size_t size);
void* __real_realloc(void* old, std::size_t size);
void* __wrap_malloc(std::size_t size) {
  fencepost::test::note();
  return __real_malloc(size);
}
void* __wrap_calloc(std::size_t count, std::size_t size) {
  fencepost::test::note();
  return __real_calloc(count, size);
}
void* __wrap_realloc(void* old, std::size_t size) {
  fencepost::test::note();
  return __real_realloc(old, size);
}
}

void* operator new(std::size_t size) {
  fencepost::test::note();
  if (void* memory = __real_malloc(size)) return memory;
  throw std::bad_alloc();
}
// Not inlined, or the compiler thinks that free() meets memory of another allocator.
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace fencepost::test {

TEST(TrappedHeap, CatchesNewAndMalloc) {
  arm();
  auto* one = new std::vector<int>(10);
  void* volatile two = std::malloc(10);
  EXPECT_EQ(disarm(), 3U);
  std::free(two);
  delete one;
}

}  // namespace fencepost::test
