// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

// Where big arrays get their memory, and the only place that requests large pages: one
// fault for 2 MB instead of 512, and a page table that stays in the cache when memory is touched
// all over. It is only a hint: where refused, pages are small and everything still works.

namespace bathyal {

inline constexpr std::size_t kLargePage = std::size_t{1} << 21U;  ///< [B]

/// Memory of the heap, for std::realloc and std::free: from kLargePage bytes on it starts on a
/// large page and ends with one, below that it starts on a cache line. Nothing is touched. nullptr
/// where there is none.
void* allocate_large(std::size_t bytes) noexcept;

/// Pages straight from the system, to be given back by `unmap_pages` with the same size; nothing is
/// touched and all of it reads as 0.
/// \throw std::bad_alloc
void* map_pages(std::size_t bytes);
void unmap_pages(void* pages, std::size_t bytes) noexcept;

}  // namespace bathyal
