// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <limits>

#include "bathyal/soundings/internal/byte_source.hpp"
#include "bathyal/soundings/internal/parse_number.hpp"
#include "bathyal/soundings/internal/text_format.hpp"

namespace bathyal::soundings {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\f' || c == '\v'; }

/// A tab is a blank unless it separates columns.
bool is_padding(char c, char separator) { return is_blank(c) && c != separator; }

bool starts_comment(std::string_view text, const TextFormat& format) {
  if (text.empty() || !format.may_comment[static_cast<unsigned char>(text.front())]) return false;
  return std::any_of(format.comments.begin(), format.comments.end(),
                     [&](const std::string& mark) { return text.starts_with(mark); });
}

bool equals_ignoring_case(std::string_view text, std::string_view lower) {
  return std::equal(text.begin(), text.end(), lower.begin(), lower.end(), [](char a, char b) {
    return (a >= 'A' && a <= 'Z' ? static_cast<char>(a + ('a' - 'A')) : a) == b;
  });
}

bool word_value(std::string_view field, double& value) {
  const bool negative = field.front() == '-';
  if (negative || field.front() == '+') field.remove_prefix(1);
  if (equals_ignoring_case(field, "nan")) {
    value = std::numeric_limits<double>::quiet_NaN();
  } else if (equals_ignoring_case(field, "inf") || equals_ignoring_case(field, "infinity")) {
    value = std::numeric_limits<double>::infinity();
  } else {
    return false;
  }
  if (negative) value = -value;
  return true;
}

/// Takes one field off the front of `line`; false when its quote is not closed. `line` is left at
/// what follows the field's padding: a separator, a comment, the next field, or nothing.
bool take_field(std::string_view& line, const TextFormat& format, std::string_view& field) {
  const char separator = format.separator;
  std::size_t end = 0;
  if (!line.empty() && (line.front() == '"' || line.front() == '\'')) {
    end = line.find(line.front(), 1);
    if (end == std::string_view::npos) return false;
    field = line.substr(1, end - 1);
    ++end;
  } else {
    while (end < line.size() && line[end] != separator &&
           !(separator == ' ' && is_blank(line[end])) &&
           !(end > 0 && is_blank(line[end - 1]) && starts_comment(line.substr(end), format))) {
      ++end;
    }
    field = line.substr(0, end);
    while (!field.empty() && is_padding(field.back(), separator)) field.remove_suffix(1);
  }
  while (end < line.size() && is_padding(line[end], separator == ' ' ? '\0' : separator)) ++end;
  line.remove_prefix(end);
  return true;
}

}  // namespace

bool split_fields(std::string_view line, const TextFormat& format, std::size_t wanted,
                  std::vector<std::string_view>& fields) {
  fields.clear();
  const char padding_not = format.separator == ' ' ? '\0' : format.separator;
  bool after_separator = false;
  while (true) {
    while (!line.empty() && is_padding(line.front(), padding_not)) line.remove_prefix(1);
    if (line.empty() || starts_comment(line, format)) break;
    std::string_view field;
    if (!take_field(line, format, field)) return false;
    fields.push_back(field);
    after_separator = !line.empty() && line.front() == format.separator;
    if (after_separator) {
      line.remove_prefix(1);
    } else if (format.separator != ' ' && !line.empty() && !starts_comment(line, format)) {
      fields.back() = {};  // something follows a closing quote: no field at all
      return false;
    }
  }
  if (after_separator && fields.size() + 1 == wanted) fields.emplace_back();
  return true;
}

bool is_blank_or_comment(std::string_view line, const TextFormat& format) {
  while (!line.empty() && is_padding(line.front(), format.separator == '\t' ? '\t' : '\0')) {
    line.remove_prefix(1);
  }
  return line.empty() || starts_comment(line, format);
}

bool is_missing(std::string_view field) {
  return field.empty() || equals_ignoring_case(field, "na") || equals_ignoring_case(field, "n/a") ||
         equals_ignoring_case(field, "null");
}

bool field_value(std::string_view field, const TextFormat& format, double& value) {
  if (is_missing(field)) {
    value = std::numeric_limits<double>::quiet_NaN();
    return format.empty_is_nan;
  }
  const char* const end = parse_number(field.data(), format.decimal, value);
  return end == field.data() + field.size() || word_value(field, value);
}

std::string_view take_line(std::string_view& text) {
  const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(end);
  if (text.starts_with("\r\n")) {
    text.remove_prefix(2);
  } else if (!text.empty()) {
    text.remove_prefix(1);
  }
  return line;
}

std::size_t find_binary(std::string_view text) {
  const auto at = std::find_if(text.begin(), text.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return (byte < 0x20 && !(byte >= '\t' && byte <= '\r')) || byte == 0x7f;
  });
  return at == text.end() ? std::string_view::npos : static_cast<std::size_t>(at - text.begin());
}

std::string not_text(std::string_view byte, std::size_t offset) {
  return "not text: byte " + printable(byte) + " at offset " + std::to_string(offset);
}

}  // namespace bathyal::soundings
