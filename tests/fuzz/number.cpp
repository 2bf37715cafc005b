// SPDX-License-Identifier: BSD-3-Clause
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "bathyal/soundings/parse_number.hpp"

// What we take for a number has the value that the C library gives it, to the last bit.
extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  if (size == 0) return 0;
  const char decimal = (data[0] & 1U) != 0 ? '.' : ',';
  std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
  const std::size_t length = text.size();
  text.append(bathyal::kTextPadding, '\0');
  double value = 0.0;
  const char* const end = bathyal::parse_number(text.data(), decimal, value);
  if (end == nullptr) return 0;
  const auto taken = static_cast<std::size_t>(end - text.data());
  if (taken == 0 || taken > length) std::abort();
  text.resize(taken);
  if (const std::size_t comma = text.find(decimal); comma != std::string::npos) text[comma] = '.';
  char* theirs = nullptr;
  const double expected = std::strtod(text.c_str(), &theirs);
  if (theirs != text.c_str() + text.size()) std::abort();
  if (std::bit_cast<std::uint64_t>(expected) != std::bit_cast<std::uint64_t>(value)) std::abort();
  return 0;
}
