// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace bathyal::scene {

/// A fixed number of plain values, not initialised, on large pages where the system has them: a
/// walk down a big hierarchy touches memory all over, and with small pages it waits for the page
/// table more than for the data.
template <class T>
class PageArray {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  PageArray() = default;

  explicit PageArray(std::size_t size) : size_(size) {
    if (size == 0) return;
    const std::size_t alignment = bytes() >= kLargePage ? kLargePage : kCacheLine;
    const std::size_t rounded = (bytes() + alignment - 1) / alignment * alignment;
    data_.reset(static_cast<T*>(std::aligned_alloc(alignment, rounded)));
    if (!data_) throw std::bad_alloc();
#if defined(__linux__)
    // A hint: where it is refused, the pages are small and everything still works.
    if (alignment == kLargePage) madvise(data_.get(), rounded, MADV_HUGEPAGE);
#endif
  }

  std::size_t size() const { return size_; }
  std::size_t bytes() const { return size_ * sizeof(T); }
  bool empty() const { return size_ == 0; }
  T* data() { return data_.get(); }
  const T* data() const { return data_.get(); }
  T& operator[](std::size_t i) { return data_.get()[i]; }
  const T& operator[](std::size_t i) const { return data_.get()[i]; }
  const T* begin() const { return data(); }
  const T* end() const { return data() + size_; }

 private:
  static constexpr std::size_t kLargePage = std::size_t{1} << 21U;
  static constexpr std::size_t kCacheLine = 64;
  static_assert(alignof(T) <= kCacheLine);

  struct Free {
    void operator()(T* p) const { std::free(p); }
  };

  std::unique_ptr<T, Free> data_;
  std::size_t size_ = 0;
};

}  // namespace bathyal::scene
