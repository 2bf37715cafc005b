// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/soundings/text_rows.hpp"

#include <algorithm>

#include "bathyal/soundings/byte_source.hpp"
#include "bathyal/soundings/parse_number.hpp"
#include "bathyal/soundings/text_blocks.hpp"

namespace bathyal {
namespace {

/// The plain row, as nearly all are: numbers, separators and blanks, nothing else. Returns where
/// the next line begins, or nullptr for anything that split_fields must look at.
template <bool kBlankSeparated>
class PlainRow {
 public:
  explicit PlainRow(const TextFormat& format)
      : separator_(format.separator),
        tab_(format.separator == '\t' ? ' ' : '\t'),
        decimal_(format.decimal),
        slots_(format.slot),
        may_comment_(format.may_comment) {}

  const char* operator()(const char* p, double* row) const {
    bool first = true;
    for (const Index slot : slots_) {
      if (!first) {
        if constexpr (kBlankSeparated) {
          if (*p != ' ' && *p != '\t') return nullptr;
        } else {
          p = skip_blanks(p);
          if (*p != separator_) return nullptr;
          ++p;
        }
      }
      first = false;
      p = skip_blanks(p);
      p = slot >= 0 ? parse_number(p, decimal_, row[slot]) : skip_text(p);
      if (p == nullptr) return nullptr;
    }
    p = skip_blanks(p);
    if (!kBlankSeparated && *p == separator_) p = skip_blanks(p + 1);
    if (*p == '\n') return p + 1;
    if (*p == '\r') return p[1] == '\n' ? p + 2 : p + 1;
    return nullptr;
  }

 private:
  const char* skip_blanks(const char* p) const {
    while (*p == ' ' || *p == tab_) ++p;
    return p;
  }

  /// A field of a column that is not wanted; not where it could be a comment, quoted or missing.
  const char* skip_text(const char* p) const {
    const char* const begin = p;
    for (;; ++p) {
      const char c = *p;
      if (c == '"' || c == '\'' || c == '\0' || may_comment_[static_cast<unsigned char>(c)]) {
        return nullptr;
      }
      if (c == '\n' || c == '\r' || c == separator_ || (kBlankSeparated && c == '\t')) break;
    }
    return p == begin ? nullptr : p;
  }

  char separator_;
  char tab_;
  char decimal_;
  const std::vector<Index>& slots_;
  const std::array<bool, 256>& may_comment_;
};

std::string in_line(std::string_view line) {
  return std::string(", in \"").append(printable(line, 100)).append("\"");
}

std::string column_text(const TextFormat& format, std::size_t column) {
  std::string text = "column " + std::to_string(column);
  if (!format.names.empty()) text.append(" (").append(format.names[column]).append(")");
  return text;
}

std::string no_number(const TextFormat& format, std::size_t column, std::string_view field) {
  std::string text("expected a number in ");
  text.append(column_text(format, column)).append(", got ");
  text.append("\"").append(printable(field)).append("\"");
  if (is_missing(field)) text += " (`empty_is_nan` would allow that)";
  if (format.decimal == '.' && field.find(',') != std::string_view::npos) {
    text += " (`separator` and `decimal` say what a comma means)";
  }
  return text;
}

/// Reads one line that is no plain row; the authority on what a line means. Returns the failure's
/// text, or nothing; `is_row` tells a row from a comment or a blank line.
std::optional<std::string> read_line(std::string_view line, const TextFormat& format, double* row,
                                     bool& is_row) {
  is_row = false;
  if (is_blank_or_comment(line, format)) return std::nullopt;
  is_row = true;
  const std::size_t columns = format.slot.size();
  std::vector<std::string_view> fields;
  if (!split_fields(line, format, columns, fields)) {
    return "a quote that does not end with its field" + in_line(line);
  }
  for (std::size_t i = 0; i < std::min(fields.size(), columns); ++i) {
    if (format.slot[i] >= 0 && !field_value(fields[i], format, row[format.slot[i]])) {
      return no_number(format, i, fields[i]) + in_line(line);
    }
  }
  if (fields.size() != columns) {
    return "expected " + std::to_string(columns) + " columns, got " +
           std::to_string(fields.size()) + in_line(line);
  }
  return std::nullopt;
}

template <bool kBlankSeparated>
void parse_rows_with(std::string_view text, std::size_t offset, const TextFormat& format,
                     TextRows& rows) {
  const PlainRow<kBlankSeparated> plain_row(format);
  const auto width = static_cast<std::size_t>(format.chosen);
  const char* const end = text.data() + text.size();
  for (const char* p = text.data(); p < end; ++rows.lines) {
    double* const row = rows.values.room_for(width);
    const char* next = plain_row(p, row);
    bool is_row = true;
    if (next == nullptr) {
      std::string_view rest(p, static_cast<std::size_t>(end - p));
      const std::string_view line = take_line(rest);
      next = rest.data();
      if (line.size() <= kLongestPiece) rows.failure = read_line(line, format, row, is_row);
    }
    if (static_cast<std::size_t>(next - p) > kLongestPiece + 2) {
      rows.failure = "a line of more than 1 MiB";
    }
    if (rows.failure) {
      const std::string_view line(p, static_cast<std::size_t>(next - p));
      const std::size_t binary = find_binary(line);
      if (binary != std::string_view::npos) {
        const auto at = offset + static_cast<std::size_t>(p - text.data()) + binary;
        rows.failure = not_text(line.substr(binary, 1), at);
      }
      return;
    }
    if (is_row) rows.values.commit(width);
    p = next;
  }
}

}  // namespace

void TextRows::clear() {
  values.clear();
  lines = 0;
  failure.reset();
}

void parse_rows(std::string_view text, std::size_t offset, const TextFormat& format,
                TextRows& rows) {
  if (format.separator == ' ') {
    parse_rows_with<true>(text, offset, format, rows);
  } else {
    parse_rows_with<false>(text, offset, format, rows);
  }
}

}  // namespace bathyal
