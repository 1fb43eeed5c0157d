// SPDX-License-Identifier: BSD-3-Clause
#include "allocation_count.h"

#include <cstdlib>
#include <new>

namespace datmo {
namespace {

std::size_t count = 0;

}  // namespace

std::size_t allocationCount() { return count; }

}  // namespace datmo

// Not inlined, as the compiler would report a mismatch.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++datmo::count;
  if (void* memory = std::malloc(size > 0 ? size : 1)) {
    return memory;
  }
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t /*size*/) noexcept {
  std::free(memory);
}
