// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/base/error.hpp"

#include <algorithm>
#include <array>
#include <charconv>

namespace bathyal {

void throw_argument(std::string_view name, std::string_view expected, std::string_view got) {
  std::string text;
  text.append("`").append(name).append("`: expected ").append(expected);
  text.append(", got ").append(got);
  std::replace(text.begin(), text.end(), '\0', '?');  // what() would end there
  throw std::invalid_argument(text);
}

void throw_at(std::string_view name, std::ptrdiff_t line, std::string_view why) {
  std::string text(name);
  text.append(":").append(std::to_string(line)).append(": ").append(why);
  throw Error(text);
}

std::string to_text(double value) {
  std::array<char, 32> buffer{};
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), result.ptr};
}

}  // namespace bathyal
