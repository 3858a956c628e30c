// SPDX-License-Identifier: BSD-3-Clause
// malloc and its kin of a program replace those of glibc in all libraries it loads: OpenCV's images do not come from new.
#include "allocation_counter.h"

#include <atomic>
#include <cerrno>
#include <cstddef>

namespace {

std::atomic<std::int64_t> allocation_count{0}, allocation_bytes{0}, largest_block{0};

void note(std::size_t size) {
  allocation_count.fetch_add(1, std::memory_order_relaxed);
  const auto bytes = static_cast<std::int64_t>(size);
  allocation_bytes.fetch_add(bytes, std::memory_order_relaxed);
  std::int64_t largest = largest_block.load(std::memory_order_relaxed);
  while (bytes > largest && !largest_block.compare_exchange_weak(largest, bytes, std::memory_order_relaxed)) {
  }
}

}  // namespace

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) {
  note(size);
  return __libc_malloc(size);
}

void* calloc(std::size_t count, std::size_t size) {
  note(count * size);
  return __libc_calloc(count, size);
}

void* realloc(void* old, std::size_t size) {
  note(size);
  return __libc_realloc(old, size);
}

void* memalign(std::size_t alignment, std::size_t size) {
  note(size);
  return __libc_memalign(alignment, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) { return memalign(alignment, size); }

int posix_memalign(void** result, std::size_t alignment, std::size_t size) {
  *result = memalign(alignment, size);
  return *result ? 0 : ENOMEM;
}
}

namespace cabinet_articulation::core::evaluation {

Allocations allocations() { return {allocation_count, allocation_bytes, largest_block.exchange(0)}; }

}  // namespace cabinet_articulation::core::evaluation
