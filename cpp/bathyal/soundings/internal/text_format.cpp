// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/soundings/internal/text_format.hpp"

#include <algorithm>
#include <utility>

#include "bathyal/base/error.hpp"
#include "bathyal/soundings/internal/byte_source.hpp"

namespace bathyal::soundings {
namespace {

constexpr std::size_t kSample = std::size_t{64} << 10U;  ///< bytes looked at to guess the format

using Fields = std::vector<std::string_view>;

struct Line {
  std::string_view text;
  Index number = 0;       ///< from 1
  std::size_t begin = 0;  ///< in the block [bytes]
};

std::string at_line(const std::string& name, Index line) {
  return name + ":" + std::to_string(line) + ": ";
}

void check_is_text(std::string_view block, const std::string& name) {
  if (block.starts_with("\xff\xfe") || block.starts_with("\xfe\xff")) {
    throw Error(name + ": UTF-16 text; save it as UTF-8");
  }
  const std::size_t at = find_binary(block.substr(0, kSample));
  if (at == std::string_view::npos) return;
  throw Error(name + ": " + not_text(block.substr(at, 1), at));
}

void set_separator(TextFormat& format, char separator, const std::vector<std::string>& comments) {
  format.separator = separator;
  format.comments.clear();
  format.may_comment.fill(false);
  for (const std::string& mark : comments) {
    if (mark.front() == separator) continue;
    format.comments.push_back(mark);
    format.may_comment[static_cast<unsigned char>(mark.front())] = true;
  }
}

/// The text outside quotes, which alone decides the separator.
std::string unquoted(std::string_view line) {
  std::string result;
  char quote = '\0';
  for (const char c : line) {
    if (quote == '\0' && (c == '"' || c == '\'')) {
      quote = c;
      result += 'q';
    } else if (c == quote) {
      quote = '\0';
    } else if (quote == '\0') {
      result += c;
    }
  }
  return quote == '\0' ? result : std::string(line);
}

/// Whether a blank lies between two other characters within one tab-separated field: then tabs and
/// blanks both are nothing but white space.
bool blanks_part_fields(const std::string& line) {
  for (std::size_t i = 1; i + 1 < line.size(); ++i) {
    if (line[i] != ' ') continue;
    const std::size_t before = line.find_last_not_of(' ', i);
    const std::size_t after = line.find_first_not_of(' ', i);
    if (before != std::string::npos && after != std::string::npos && line[before] != '\t' &&
        line[after] != '\t') {
      return true;
    }
  }
  return false;
}

char guess_separator(std::string_view line, char decimal) {
  const std::string text = unquoted(line);
  if (text.find(';') != std::string::npos) return ';';
  if (text.find('\t') != std::string::npos) return blanks_part_fields(text) ? ' ' : '\t';
  if (decimal != ',' && text.find(',') != std::string::npos) return ',';
  return ' ';
}

enum class Comma { kNone, kDecimal, kThousands };

/// "1,234" and "-52,913" may be either; any other number with one comma has decimals behind it.
Comma comma_in(std::string_view field) {
  if (field.starts_with('-') || field.starts_with('+')) field.remove_prefix(1);
  const std::size_t comma = field.find(',');
  if (comma == std::string_view::npos ||
      field.find_first_not_of("0123456789,eE+-") != std::string_view::npos ||
      field.find(',', comma + 1) != std::string_view::npos) {
    return Comma::kNone;
  }
  const bool three_behind = field.size() - comma == 4;
  const bool one_to_three_before = comma >= 1 && comma <= 3 && field.front() != '0';
  return three_behind && one_to_three_before ? Comma::kThousands : Comma::kDecimal;
}

char guess_decimal(const std::vector<Line>& sample, const TextFormat& format,
                   const std::string& name) {
  if (format.separator != ';' && format.separator != '\t') return '.';
  const Line* doubtful = nullptr;
  std::string_view doubtful_field;
  bool decimal_comma = false;
  Fields fields;
  for (const Line& line : sample) {
    split_fields(line.text, format, 0, fields);
    for (const std::string_view field : fields) {
      double value = 0.0;
      if (field.find('.') != std::string_view::npos && field_value(field, format, value)) {
        return '.';
      }
      const Comma comma = comma_in(field);
      decimal_comma = decimal_comma || comma == Comma::kDecimal;
      if (comma == Comma::kThousands && doubtful == nullptr) {
        doubtful = &line;
        doubtful_field = field;
      }
    }
  }
  if (!decimal_comma && doubtful != nullptr) {
    throw Error(at_line(name, doubtful->number) + "\"" + printable(doubtful_field) +
                "\" may have decimals or thousands behind its comma; say which with `decimal`");
  }
  return decimal_comma ? ',' : '.';
}

/// The lines of the block behind `skip_lines`, as far as the first `limit` bytes reach; all of them
/// when not a single one of those holds numbers.
std::vector<Line> lines_of(std::string_view block, std::size_t limit, int skip_lines) {
  std::vector<Line> lines;
  std::string_view rest = block;
  for (Index number = 1; !rest.empty(); ++number) {
    const std::size_t begin = block.size() - rest.size();
    if (begin > limit) break;
    const std::string_view text = take_line(rest);
    if (number > skip_lines) lines.push_back({text, number, begin});
  }
  return lines;
}

std::vector<Line> content_of(const std::vector<Line>& lines, const TextFormat& format) {
  std::vector<Line> content;
  std::copy_if(lines.begin(), lines.end(), std::back_inserter(content),
               [&](const Line& line) { return !is_blank_or_comment(line.text, format); });
  return content;
}

/// A row of numbers, as far as the wanted columns go; a row of empty fields counts as one.
bool is_row(const Fields& fields, const TextFormat& format, const TextOptions& options) {
  TextFormat lenient = format;
  lenient.empty_is_nan = true;
  double value = 0.0;
  bool by_index = !options.columns.empty();
  for (const auto& column : options.columns) {
    const auto* index = std::get_if<Index>(&column);
    by_index = by_index && index != nullptr && *index < static_cast<Index>(fields.size());
  }
  if (!by_index) {
    return std::any_of(fields.begin(), fields.end(),
                       [&](std::string_view field) { return field_value(field, lenient, value); });
  }
  return std::any_of(options.columns.begin(), options.columns.end(), [&](const auto& column) {
    const auto index = static_cast<std::size_t>(std::get<Index>(column));
    return field_value(fields[index], lenient, value);
  });
}

std::vector<std::string> as_names(const Fields& fields) {
  std::vector<std::string> names;
  for (const std::string_view field : fields) names.push_back(printable(field));
  return names;
}

/// Names in a comment above the rows ("# x y z", "//X Y Z").
std::vector<std::string> names_in_comment(std::string_view line, const TextFormat& format) {
  line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  const std::size_t begin = line.find_first_not_of("#/%!;* \t");
  Fields fields;
  if (begin == std::string_view::npos || !split_fields(line.substr(begin), format, 0, fields)) {
    return {};
  }
  double value = 0.0;
  const bool numbers = std::any_of(fields.begin(), fields.end(), [&](std::string_view field) {
    return field.empty() || field_value(field, format, value);
  });
  return numbers ? std::vector<std::string>{} : as_names(fields);
}

/// Finds the first row, the names above it and the number of columns.
void read_header(const std::vector<Line>& lines, const TextOptions& options,
                 const std::string& name, TextFormat& format) {
  Fields fields;
  int header_lines = 0;
  std::vector<std::string> commented;
  for (const Line& line : lines) {
    if (is_blank_or_comment(line.text, format)) {
      const auto names = names_in_comment(line.text, format);
      if (!names.empty()) commented = names;
      continue;
    }
    split_fields(line.text, format, 0, fields);
    const bool header = options.header_lines < 0 ? !is_row(fields, format, options)
                                                 : header_lines < options.header_lines;
    if (header) {
      ++header_lines;
      format.names = as_names(fields);
      continue;
    }
    for (auto* names : {&format.names, &commented}) {
      split_fields(line.text, format, names->size(), fields);
      if (fields.size() == names->size()) break;
    }
    if (fields.size() != format.names.size()) {
      format.names = fields.size() == commented.size() ? commented : std::vector<std::string>{};
    }
    format.slot.assign(fields.size(), -1);
    format.begin = line.begin;
    format.lines_before = line.number - 1;
    return;
  }
  throw Error(name + ": no row of numbers in " + std::to_string(lines.size()) + " lines" +
              (header_lines > 0
                   ? ", of which " + std::to_string(header_lines) + " look like a header"
                   : ""));
}

Index find_column(const std::variant<Index, std::string>& column, const TextFormat& format) {
  const auto count = static_cast<Index>(format.slot.size());
  if (const auto* index = std::get_if<Index>(&column)) {
    if (*index < count) return *index;
    throw_argument("columns", "indices below " + std::to_string(count), std::to_string(*index));
  }
  const std::string& wanted = std::get<std::string>(column);
  const auto lower = [](std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](char c) {
      return c >= 'A' && c <= 'Z' ? static_cast<char>(c + ('a' - 'A')) : c;
    });
    return text;
  };
  for (Index i = 0; i < static_cast<Index>(format.names.size()); ++i) {
    if (format.names[static_cast<std::size_t>(i)] == wanted) return i;
  }
  for (Index i = 0; i < static_cast<Index>(format.names.size()); ++i) {
    if (lower(format.names[static_cast<std::size_t>(i)]) == lower(wanted)) return i;
  }
  throw_argument("columns",
                 format.names.empty() ? "indices, for the file names no columns"
                                      : "one of " + format.names_of_columns(),
                 "\"" + wanted + "\"");
}

void choose_columns(const TextOptions& options, TextFormat& format) {
  if (options.columns.empty()) {
    for (std::size_t i = 0; i < format.slot.size(); ++i) format.slot[i] = static_cast<Index>(i);
    format.chosen = static_cast<Index>(format.slot.size());
    return;
  }
  for (const auto& column : options.columns) {
    Index& slot = format.slot[static_cast<std::size_t>(find_column(column, format))];
    if (slot >= 0) throw_argument("columns", "each column once", "a column twice");
    slot = format.chosen++;
  }
}

}  // namespace

std::string TextFormat::names_of_columns() const {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "\"" : ", \"") + name + "\"";
  return text;
}

TextFormat detect_format(std::string_view block, const TextOptions& options,
                         const std::string& name) {
  check_is_text(block, name);
  const std::size_t mark = block.starts_with("\xef\xbb\xbf") ? 3 : 0;
  TextFormat format;
  set_separator(format, options.separator, options.comments);
  format.decimal = options.decimal == ',' ? ',' : '.';
  std::vector<Line> lines = lines_of(block.substr(mark), kSample, options.skip_lines);
  std::vector<Line> content = content_of(lines, format);
  if (content.size() < 2) {  // a long comment or a few long lines: look at all there is
    lines = lines_of(block.substr(mark), block.size(), options.skip_lines);
    content = content_of(lines, format);
  }
  if (options.separator == '\0' && !content.empty()) {
    // The last line is the least likely to be a header.
    set_separator(format, guess_separator(content.back().text, format.decimal), options.comments);
  }
  if (options.decimal == '\0') format.decimal = guess_decimal(content, format, name);
  read_header(lines, options, name, format);
  choose_columns(options, format);
  format.empty_is_nan = options.empty_is_nan;
  format.begin += mark;
  return format;
}

}  // namespace bathyal::soundings
