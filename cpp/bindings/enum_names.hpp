// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bathyal/base/error.hpp"

namespace bathyal::python {

/// An enum's values with their names in Python.
template <class Enum>
using EnumNames = std::vector<std::pair<std::string, Enum>>;

/// \throw std::invalid_argument that lists the names for one that is not among them.
template <class Enum>
Enum enum_argument(std::string_view name, const std::string& given, const EnumNames<Enum>& names) {
  std::string expected;
  for (const auto& [known, value] : names) {
    if (known == given) return value;
    expected += (expected.empty() ? "\"" : " or \"") + known + "\"";
  }
  throw_argument(name, expected, "\"" + given + "\"");
}

template <class Enum>
std::string enum_name(Enum value, const EnumNames<Enum>& names) {
  for (const auto& [name, known] : names) {
    if (known == value) return name;
  }
  return {};
}

}  // namespace bathyal::python
