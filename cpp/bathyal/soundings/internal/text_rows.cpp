// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/soundings/internal/text_rows.hpp"

#include <algorithm>

#include "bathyal/soundings/internal/byte_source.hpp"
#include "bathyal/soundings/internal/field_ends.hpp"
#include "bathyal/soundings/internal/parse_number.hpp"
#include "bathyal/soundings/internal/plain_decimal.hpp"
#include "bathyal/soundings/internal/text_blocks.hpp"

namespace bathyal::soundings {
namespace {

/// Whether a comment could be taken for a number.
bool numbers_may_be_comments(const TextFormat& format) {
  const std::string_view bytes = "+-.,0123456789";
  return std::any_of(bytes.begin(), bytes.end(),
                     [&](char c) { return format.may_comment[static_cast<unsigned char>(c)]; });
}

bool is_line_end(char c) { return c == '\n' || c == '\r'; }

static_assert(kTextPadding >= kFieldBlock);

/// Plain rows, as nearly all are: numbers, separators and blanks, nothing else.
template <bool kBlankSeparated>
class PlainRows {
 public:
  PlainRows(const char* text, const TextFormat& format)
      : ends_(text, format.separator),
        tab_(format.separator == '\t' ? ' ' : '\t'),
        decimal_(format.decimal),
        any_(!numbers_may_be_comments(format)),
        slots_(format.slot),
        may_comment_(format.may_comment) {}

  /// Reads the row at `line` and returns where the next line begins, or nullptr for anything that
  /// read_line must look at; then `seek` says where to go on.
  const char* read(const char* line, double* row) {
    if (!any_) return nullptr;
    const char* begin = line;
    const char* end = line;
    for (std::size_t i = 0; i < slots_.size(); ++i, begin = end + 1) {
      if (i > 0 && is_line_end(*end)) return nullptr;  // fewer columns than there should be
      end = ends_.next();
      const Index slot = slots_[i];
      const bool plain = slot >= 0 ? read_number(begin, end, row[slot]) : is_plain_text(begin, end);
      if (!plain) return nullptr;
    }
    if (!is_line_end(*end)) {  // a separator, or blanks, at the end of the line
      begin = skip_blanks(begin);
      end = ends_.next();
      if (begin != end || !is_line_end(*end)) return nullptr;
    }
    if (*end == '\r' && end[1] == '\n') end = ends_.next();
    return end + 1;
  }

  void seek(const char* line) { ends_.seek(line); }

 private:
  const char* skip_blanks(const char* p) const {
    while (*p == ' ' || *p == tab_) ++p;
    return p;
  }

  bool read_number(const char* begin, const char* end, double& value) const {
    if (parse_plain_decimal(begin, end, decimal_, value)) return true;
    begin = skip_blanks(begin);
    if (parse_plain_decimal(begin, end, decimal_, value)) return true;
    const char* const number_end = parse_number(begin, decimal_, value);
    return number_end != nullptr && skip_blanks(number_end) == end;
  }

  /// A field of a column that is not wanted; not where it could be a comment, quoted or missing.
  bool is_plain_text(const char* begin, const char* end) const {
    begin = skip_blanks(begin);
    return begin < end && std::none_of(begin, end, [&](char c) {
             const auto byte = static_cast<unsigned char>(c);
             return byte < 0x20 || c == '"' || c == '\'' || may_comment_[byte];
           });
  }

  FieldEnds<kBlankSeparated> ends_;
  char tab_;
  char decimal_;
  bool any_;  ///< whether any row may be read without looking for comments
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
/// text, or nothing; `is_row` is false for a comment or a blank line.
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
  PlainRows<kBlankSeparated> plain_rows(text.data(), format);
  const auto width = static_cast<std::size_t>(format.chosen);
  const char* const end = text.data() + text.size();
  for (const char* p = text.data(); p < end; ++rows.lines) {
    double* const row = rows.values.room_for(width);
    const char* next = plain_rows.read(p, row);
    bool is_row = true;
    if (next == nullptr) {
      std::string_view rest(p, static_cast<std::size_t>(end - p));
      const std::string_view line = take_line(rest);
      next = rest.data();
      plain_rows.seek(next);
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

}  // namespace bathyal::soundings
