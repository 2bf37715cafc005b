// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/base/text.hpp"

#include <cstdio>
#include <numbers>

namespace bathyal {

std::string three_digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

std::string millimetres(double metres) { return three_digits(metres * 1e3) + " mm"; }

std::string degrees(double radians) {
  return three_digits(radians * 180.0 / std::numbers::pi) + " deg";
}

std::string in_its_unit(double value, const std::string& unit) {
  return unit == "rad" ? degrees(value) : millimetres(value);
}

std::string counted(long count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many.empty() ? one + "s" : many);
}

std::string listed(const std::vector<std::string>& items, std::size_t most) {
  const bool all = items.size() <= most;
  const std::size_t shown = all ? items.size() : most;
  std::string text;
  for (std::size_t i = 0; i < shown; ++i) {
    if (i > 0) text += all && i + 1 == shown ? " and " : ", ";
    text += items[i];
  }
  if (!all) text += " and " + std::to_string(items.size() - most) + " more";
  return text;
}

std::string listed(const std::vector<int>& items, std::size_t most) {
  std::vector<std::string> texts;
  for (const int item : items) texts.push_back(std::to_string(item));
  return listed(texts, most);
}

}  // namespace bathyal
