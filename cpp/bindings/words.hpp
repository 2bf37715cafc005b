// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bathyal/base/error.hpp"

namespace bathyal::python {

/// The names of an enum's values in Python.
template <class Enum>
using Words = std::vector<std::pair<std::string, Enum>>;

/// \throw std::invalid_argument that lists the words for one that is not among them.
template <class Enum>
Enum word_argument(std::string_view name, const std::string& word, const Words<Enum>& words) {
  std::string expected;
  for (const auto& [known, value] : words) {
    if (known == word) return value;
    expected += (expected.empty() ? "\"" : " or \"") + known + "\"";
  }
  throw_argument(name, expected, "\"" + word + "\"");
}

template <class Enum>
std::string word_of(Enum value, const Words<Enum>& words) {
  for (const auto& [word, known] : words) {
    if (known == value) return word;
  }
  return {};
}

}  // namespace bathyal::python
