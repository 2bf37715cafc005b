// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/soundings/text_table.hpp"

#include <algorithm>
#include <memory>

#include "bathyal/base/error.hpp"
#include "bathyal/base/parallel.hpp"
#include "bathyal/soundings/ascii_grid.hpp"
#include "bathyal/soundings/text_blocks.hpp"
#include "bathyal/soundings/text_rows.hpp"

namespace bathyal {
namespace {

/// The result while it grows.
class Columns {
 public:
  Columns(std::size_t chosen, std::size_t width) : chosen_(chosen), width_(width) {
    extra_.resize(chosen - width);
  }

  /// Appends the rows of all parts, in order, with every thread copying parts of its own.
  void append(const std::vector<TextRows>& parts, std::size_t count, int num_threads) {
    std::vector<std::size_t> first(count + 1, 0);
    for (std::size_t i = 0; i < count; ++i) {
      first[i + 1] = first[i] + parts[i].values.size() / chosen_;
    }
    double* const table = table_.room_for(first[count] * width_);
    std::vector<double*> extra;
    for (GrowingArray<double>& column : extra_) extra.push_back(column.room_for(first[count]));
    parallel_for(count, 1, num_threads, [&](std::size_t i, std::size_t) {
      copy(parts[i].values, first[i], table, extra);
    });
    table_.commit(first[count] * width_);
    for (GrowingArray<double>& column : extra_) column.commit(first[count]);
  }

  void release(TextTable& result) {
    result.width = static_cast<Index>(width_);
    result.rows = static_cast<Index>(table_.size() / width_);
    result.table = values_of(table_);
    for (GrowingArray<double>& column : extra_) result.extra.push_back(values_of(column));
  }

 private:
  void copy(const GrowingArray<double>& rows, std::size_t first, double* table,
            const std::vector<double*>& extra) const {
    const double* from = rows.data();
    double* to = table + first * width_;
    if (extra.empty()) {
      std::copy_n(from, rows.size(), to);
      return;
    }
    for (std::size_t i = 0; i < rows.size() / chosen_; ++i, from += chosen_, to += width_) {
      std::copy_n(from, width_, to);
      for (std::size_t j = 0; j < extra.size(); ++j) extra[j][first + i] = from[width_ + j];
    }
  }

  static Values values_of(GrowingArray<double>& array) {
    const auto count = static_cast<Index>(array.size());
    std::shared_ptr<const double> data = array.release();
    return {data.get(), count, data};
  }

  std::size_t chosen_;
  std::size_t width_;
  GrowingArray<double> table_;
  std::vector<GrowingArray<double>> extra_;
};

[[noreturn]] void throw_at(const std::string& name, Index line, const std::string& why) {
  throw Error(name + ":" + std::to_string(line) + ": " + why);
}

Columns new_columns(const TextOptions& options, const TextFormat& format) {
  if (options.leading > format.chosen) {
    throw_argument("leading", "no more than the " + std::to_string(format.chosen) + " columns",
                   std::to_string(options.leading));
  }
  const Index width = options.leading > 0 ? options.leading : format.chosen;
  return {static_cast<std::size_t>(format.chosen), static_cast<std::size_t>(width)};
}

std::vector<std::string> chosen_names(const TextFormat& format) {
  if (format.names.empty()) return {};
  std::vector<std::string> names(static_cast<std::size_t>(format.chosen));
  for (std::size_t i = 0; i < format.slot.size(); ++i) {
    if (format.slot[i] >= 0) names[static_cast<std::size_t>(format.slot[i])] = format.names[i];
  }
  return names;
}

/// Lines ended in the parts; throws for the first line that could not be read.
Index check_parts(const std::vector<TextRows>& parts, std::size_t count, Index lines,
                  const std::string& name) {
  for (std::size_t i = 0; i < count; ++i) {
    lines += parts[i].lines;
    if (parts[i].failure) throw_at(name, lines + 1, *parts[i].failure);
  }
  return lines;
}

TextTable read_rows(TextBlocks& blocks, const TextOptions& options, const std::string& name) {
  blocks.start(TextCut::kLine);
  const TextFormat format = detect_format(blocks.block(), options, name);
  blocks.skip(format.begin);
  Columns columns = new_columns(options, format);
  std::vector<TextRows> parts;
  Index lines = format.lines_before;
  while (!blocks.block().empty()) {
    const std::size_t count = blocks.part_count();
    const std::size_t offset = blocks.offset();
    const char* const begin = blocks.block().data();
    if (parts.size() < count) parts.resize(count);
    blocks.parse_parts(options.num_threads, [&](std::size_t i, std::string_view text) {
      parts[i].clear();
      parse_rows(text, offset + static_cast<std::size_t>(text.data() - begin), format, parts[i]);
    });
    lines = check_parts(parts, count, lines, name);
    columns.append(parts, count, options.num_threads);
  }
  if (blocks.too_long()) throw_at(name, lines + 1, "a line of more than 1 MiB");
  TextTable result;
  columns.release(result);
  result.names = chosen_names(format);
  result.separator = format.separator;
  result.decimal = format.decimal;
  return result;
}

/// An ASCII grid, as the table of its points.
TextTable read_grid(TextBlocks& blocks, const TextOptions& options, const std::string& name) {
  if (!options.columns.empty() || (options.leading != 0 && options.leading != 3)) {
    throw_argument("columns", "none for an ESRI ASCII grid, which gives x, y and z", "a choice");
  }
  const AsciiGrid grid = read_grid_blocks(blocks, options.num_threads, name);
  TextTable result;
  result.rows = grid.points.rows();
  result.width = 3;
  result.table = Values(grid.points.data(), 3 * result.rows, grid.points.owner());
  result.names = {"x", "y", "z"};
  result.grid = true;
  return result;
}

TextTable read_table(ByteSource& source, const TextOptions& options, const std::string& name) {
  TextBlocks blocks(source);
  if (blocks.head().empty()) throw Error(name + ": the file is empty");
  return is_ascii_grid(blocks.head()) ? read_grid(blocks, options, name)
                                      : read_rows(blocks, options, name);
}

std::string separator_text(char separator) {
  return separator == '\t' ? "\\t" : std::string(1, separator);
}

}  // namespace

void TextOptions::check() const {
  if (std::string_view("\0 ,;\t", 5).find(separator) == std::string_view::npos) {
    throw_argument("separator", "a blank, comma, semicolon or tab", separator_text(separator));
  }
  if (std::string_view("\0.,", 3).find(decimal) == std::string_view::npos) {
    throw_argument("decimal", "a point or a comma", std::string(1, decimal));
  }
  if (decimal == ',' && separator == ',') {
    throw_argument("decimal", "another character than the separator", ",");
  }
  for (const std::string& mark : comments) {
    if (mark.empty()) throw_argument("comments", "marks of one character or more", "an empty one");
  }
  if (header_lines < -1) throw_argument("header_lines", "-1 or more", std::to_string(header_lines));
  if (skip_lines < 0) throw_argument("skip_lines", "0 or more", std::to_string(skip_lines));
  if (leading < 0) throw_argument("leading", "0 or more", std::to_string(leading));
  for (const auto& column : columns) {
    const auto* index = std::get_if<Index>(&column);
    if (index != nullptr && *index < 0) {
      throw_argument("columns", "indices of 0 or more", std::to_string(*index));
    }
  }
  resolve_threads(num_threads);
}

TextTable read_text_table(const std::filesystem::path& path, const TextOptions& options) {
  options.check();
  return read_table(*open_file(path), options, printable(path.native(), 400));
}

TextTable parse_text_table(std::string_view text, const TextOptions& options,
                           const std::string& name) {
  options.check();
  return read_table(*open_memory(text), options, name);
}

}  // namespace bathyal
