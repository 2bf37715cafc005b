// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>
#include <limits>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>

#include "bathyal/base/large_pages.hpp"

namespace bathyal::soundings {

/// Numbers that are appended without knowing how many there will be. Unlike std::vector it neither
/// clears new memory nor copies when it grows large: realloc moves pages, and pages that were never
/// written cost nothing. So the result of a reader is never held twice.
template <class Scalar>
class GrowingArray {
  static_assert(std::is_trivially_copyable_v<Scalar>);

 public:
  GrowingArray() = default;
  GrowingArray(GrowingArray&& other) noexcept
      : data_(std::exchange(other.data_, nullptr)),
        size_(std::exchange(other.size_, 0)),
        capacity_(std::exchange(other.capacity_, 0)) {}
  GrowingArray& operator=(GrowingArray&& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    std::swap(capacity_, other.capacity_);
    return *this;
  }
  GrowingArray(const GrowingArray&) = delete;
  GrowingArray& operator=(const GrowingArray&) = delete;
  ~GrowingArray() { std::free(data_); }

  std::size_t size() const { return size_; }
  const Scalar* data() const { return data_; }
  void clear() { size_ = 0; }

  /// Makes room for `count` more and returns where they go; `commit` says how many were written.
  Scalar* room_for(std::size_t count) {
    if (count > capacity_ - size_) grow(count);
    return data_ + size_;
  }
  void commit(std::size_t count) { size_ += count; }

  /// Reserves room for `count` while the array is still empty, on large pages where that is
  /// megabytes: faulting small pages in one by one costs half as much as parsing what fills them.
  /// A guess that is too high costs no memory, one that is refused or too low costs time only.
  void expect(std::size_t count) {
    if (data_ != nullptr || count < kLargePage / sizeof(Scalar)) return;
    if (count > kLargest) return;
    data_ = static_cast<Scalar*>(allocate_large(count * sizeof(Scalar)));
    if (data_ != nullptr) capacity_ = count;
  }

  void push_back(Scalar value) {
    *room_for(1) = value;
    commit(1);
  }

  /// Gives back what was not used and hands the memory over.
  std::shared_ptr<const Scalar> release() {
    if (size_ < capacity_ && size_ > 0) reallocate(size_);
    capacity_ = 0;
    size_ = 0;
    return {std::exchange(data_, nullptr),
            [](const Scalar* p) { std::free(const_cast<Scalar*>(p)); }};
  }

 private:
  static constexpr std::size_t kLargest =
      std::numeric_limits<std::ptrdiff_t>::max() / sizeof(Scalar);

  void grow(std::size_t count) {
    if (count > kLargest - size_) throw std::bad_alloc();
    const std::size_t doubled = capacity_ > kLargest / 2 ? kLargest : 2 * capacity_;
    reallocate(doubled > size_ + count ? doubled : size_ + count);
  }

  void reallocate(std::size_t capacity) {
    void* const moved = std::realloc(data_, capacity * sizeof(Scalar));
    if (moved == nullptr) throw std::bad_alloc();
    data_ = static_cast<Scalar*>(moved);
    capacity_ = capacity;
  }

  Scalar* data_ = nullptr;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

}  // namespace bathyal::soundings
