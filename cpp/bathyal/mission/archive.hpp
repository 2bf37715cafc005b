// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "bathyal/base/error.hpp"
#include "bathyal/geometry/pose.hpp"

namespace bathyal {

// States as bytes and back: `archive(a, state)` lists a struct's members once, for both ways.
// Numbers are written as they are in memory (little-endian on every machine this runs on).

class ByteWriter {
 public:
  static constexpr bool kReads = false;

  template <class... Values>
  void operator()(Values&... values) {
    (archive(*this, values), ...);
  }
  void raw(const void* data, std::size_t size) {
    bytes_.append(static_cast<const char*>(data), size);
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

class ByteReader {
 public:
  static constexpr bool kReads = true;

  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  template <class... Values>
  void operator()(Values&... values) {
    (archive(*this, values), ...);
  }
  /// \throw Error where the bytes end too early
  void raw(void* data, std::size_t size) {
    if (size > bytes_.size()) throw Error("a saved run ends too early");
    std::memcpy(data, bytes_.data(), size);
    bytes_.remove_prefix(size);
  }
  std::size_t left() const { return bytes_.size(); }

 private:
  std::string_view bytes_;
};

template <class Archive, class Value>
requires(std::is_arithmetic_v<Value> || std::is_enum_v<Value>) void archive(Archive& a,
                                                                            Value& value) {
  if constexpr (std::is_same_v<Value, bool>) {  // no byte but 0 and 1 is one
    auto byte = static_cast<std::uint8_t>(value);
    a.raw(&byte, sizeof byte);
    if (byte > 1) throw Error("a saved run that was changed");
    value = byte == 1;
  } else {
    a.raw(&value, sizeof value);
  }
}

template <class Archive, class Scalar, int Rows, int Cols, int Options>
void archive(Archive& a, Eigen::Matrix<Scalar, Rows, Cols, Options>& matrix) {
  static_assert(Rows > 0 && Cols > 0);
  a.raw(matrix.data(), sizeof(Scalar) * Rows * Cols);
}

template <class Archive>
void archive(Archive& a, Pose& pose) {
  a.raw(pose.matrix().data(), sizeof(double) * 16);
}

template <class Archive, class Value, std::size_t Size>
void archive(Archive& a, std::array<Value, Size>& values) {
  for (Value& value : values) archive(a, value);
}

template <class Archive>
void archive(Archive& a, std::string& text) {
  auto size = static_cast<std::uint64_t>(text.size());
  archive(a, size);
  if constexpr (Archive::kReads) {
    if (size > a.left()) throw Error("a saved run ends too early");
    text.resize(size);
  }
  a.raw(text.data(), text.size());
}

template <class Archive, class Value>
void archive(Archive& a, std::vector<Value>& values) {
  auto size = static_cast<std::uint64_t>(values.size());
  archive(a, size);
  if constexpr (Archive::kReads) {
    if (size > a.left()) throw Error("a saved run ends too early");
    values.resize(size);
  }
  for (Value& value : values) archive(a, value);
}

}  // namespace bathyal
