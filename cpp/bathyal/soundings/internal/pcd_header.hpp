// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace bathyal::soundings {

enum class PcdData { kAscii, kBinary, kCompressed };

struct PcdField {
  std::string name;
  char type = 'F';         ///< 'I', 'U' or 'F'
  std::size_t size = 4;    ///< of one number [bytes]
  std::size_t count = 1;   ///< numbers
  std::size_t offset = 0;  ///< in a point [bytes]
  std::size_t column = 0;  ///< of its first number in a line of ascii data
};

/// The header of a PCD file, checked: points · point_size does not overflow.
struct PcdHeader {
  std::vector<PcdField> fields;
  std::size_t points = 0;
  std::size_t point_size = 0;  ///< [bytes]
  std::size_t columns = 0;     ///< numbers a point
  PcdData data = PcdData::kAscii;
  std::size_t bytes = 0;  ///< length of the header
  std::size_t lines = 0;

  const PcdField* find(std::string_view name) const;
};

/// \throw Error that names `name` and the line.
PcdHeader read_pcd_header(std::string_view bytes, const std::string& name);

}  // namespace bathyal::soundings
