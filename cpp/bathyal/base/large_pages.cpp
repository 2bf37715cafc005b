// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/base/large_pages.hpp"

#include <sys/mman.h>

#include <cstdlib>
#include <limits>
#include <new>

namespace bathyal {
namespace {

constexpr std::size_t kCacheLine = 64;

void wish_for_large_pages([[maybe_unused]] void* pages, [[maybe_unused]] std::size_t bytes) {
#ifdef MADV_HUGEPAGE
  madvise(pages, bytes, MADV_HUGEPAGE);
#endif
}

}  // namespace

void* allocate_large(std::size_t bytes) noexcept {
  const std::size_t alignment = bytes >= kLargePage ? kLargePage : kCacheLine;
  if (bytes > std::numeric_limits<std::ptrdiff_t>::max() - alignment) return nullptr;
  const std::size_t rounded = (bytes + alignment - 1) / alignment * alignment;
  void* const memory = std::aligned_alloc(alignment, rounded);
  if (memory != nullptr && alignment == kLargePage) wish_for_large_pages(memory, rounded);
  return memory;
}

void* map_pages(std::size_t bytes) {
  void* const pages =
      mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (pages == MAP_FAILED) throw std::bad_alloc();
  if (bytes >= kLargePage) wish_for_large_pages(pages, bytes);
  return pages;
}

void unmap_pages(void* pages, std::size_t bytes) noexcept { munmap(pages, bytes); }

}  // namespace bathyal
