#include "tests/support/allocations.hpp"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {
std::atomic<bool> counting{false};
std::atomic<long> count{0};
}  // namespace

// Not inlined: the compiler would see free() meet a pointer from new and warn.
[[gnu::noinline]] void* operator new(std::size_t size) {
  if (counting) ++count;
  if (void* p = std::malloc(size)) return p;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* p) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept { std::free(p); }

namespace longreach::test {

void count_allocations(bool on) {
  if (on) count = 0;
  counting = on;
}
long allocations() { return count; }

}  // namespace longreach::test
