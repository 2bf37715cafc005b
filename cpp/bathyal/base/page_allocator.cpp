// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/base/page_allocator.hpp"

#include <sys/mman.h>

#include <new>

namespace bathyal {

namespace {

constexpr std::size_t kHugeFrom = std::size_t{4} << 20U;

}  // namespace

void* allocate_pages(std::size_t bytes) {
  void* pages = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (pages == MAP_FAILED) throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
  // One fault for 2 MB instead of 512: a wish the system may ignore.
  if (bytes >= kHugeFrom) madvise(pages, bytes, MADV_HUGEPAGE);
#endif
  return pages;
}

void free_pages(void* pages, std::size_t bytes) noexcept { munmap(pages, bytes); }

}  // namespace bathyal
