// SPDX-License-Identifier: BSD-3-Clause
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "bathyal/soundings/internal/parse_number.hpp"
#include "bathyal/soundings/internal/plain_decimal.hpp"

namespace {

void check_value(std::string text, char decimal, double value) {
  if (const std::size_t mark = text.find(decimal); mark != std::string::npos) text[mark] = '.';
  char* theirs = nullptr;
  const double expected = std::strtod(text.c_str(), &theirs);
  if (theirs != text.c_str() + text.size()) std::abort();
  if (std::bit_cast<std::uint64_t>(expected) != std::bit_cast<std::uint64_t>(value)) std::abort();
}

}  // namespace

// What we take for a number has the value that the C library gives it, to the last bit; and what
// we take for a plain decimal is a number.
extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  if (size == 0) return 0;
  const char decimal = (data[0] & 1U) != 0 ? '.' : ',';
  const std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
  const std::string padded = text + ';' + std::string(bathyal::soundings::kTextPadding, '\0');
  double value = 0.0;
  if (bathyal::soundings::parse_plain_decimal(padded.data(), padded.data() + text.size(), decimal,
                                              value)) {
    check_value(text, decimal, value);
  }
  const char* const end = bathyal::soundings::parse_number(padded.data(), decimal, value);
  if (end == nullptr) return 0;
  const auto taken = static_cast<std::size_t>(end - padded.data());
  if (taken == 0 || taken > text.size()) std::abort();
  check_value(text.substr(0, taken), decimal, value);
  return 0;
}
