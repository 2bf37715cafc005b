// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdlib>
#include <limits>
#include <memory>
#include <new>
#include <type_traits>

#include "bathyal/base/large_pages.hpp"

namespace bathyal {

/// A fixed number of plain values that nothing sets, on large pages from 2 MB on: for arrays that
/// threads fill together or that are read all over, such as a hierarchy. A small one costs no more
/// than any other of the heap.
template <class T>
class PageArray {
  static_assert(std::is_trivially_copyable_v<T>);
  static_assert(alignof(T) <= 64);

 public:
  PageArray() = default;

  /// \throw std::bad_alloc
  explicit PageArray(std::size_t size) : size_(size) {
    if (size == 0) return;
    if (size > std::numeric_limits<std::ptrdiff_t>::max() / sizeof(T)) throw std::bad_alloc();
    data_.reset(static_cast<T*>(allocate_large(bytes())));
    if (!data_) throw std::bad_alloc();
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
  struct Free {
    void operator()(T* p) const { std::free(p); }
  };

  std::unique_ptr<T, Free> data_;
  std::size_t size_ = 0;
};

}  // namespace bathyal
