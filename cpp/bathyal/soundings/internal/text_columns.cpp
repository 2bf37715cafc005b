// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/soundings/internal/text_columns.hpp"

#include <algorithm>
#include <memory>

#include "bathyal/base/error.hpp"
#include "bathyal/base/parallel.hpp"
#include "bathyal/soundings/internal/text_rows.hpp"

namespace bathyal::soundings {
namespace {

/// The result while it grows.
class Columns {
 public:
  Columns(std::size_t chosen, std::size_t width) : chosen_(chosen), width_(width) {
    extra_.resize(chosen - width);
  }

  /// Makes room, before the first rows, for so many rows as a source of `share` times the bytes
  /// that gave these parts should give.
  void expect(const std::vector<TextRows>& parts, std::size_t count, double share) {
    std::size_t rows = 0;
    for (std::size_t i = 0; i < count; ++i) rows += parts[i].values.size() / chosen_;
    const double expected = 1.01 * share * static_cast<double>(rows);
    if (!(expected < kMostExpected)) return;
    table_.expect(static_cast<std::size_t>(expected) * width_);
    for (GrowingArray<double>& column : extra_) column.expect(static_cast<std::size_t>(expected));
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

  bool empty() const { return table_.size() == 0; }

  void release(TextTable& result) {
    result.width = static_cast<Index>(width_);
    result.rows = static_cast<Index>(table_.size() / width_);
    result.table = values_of(table_);
    for (GrowingArray<double>& column : extra_) result.extra.push_back(values_of(column));
  }

 private:
  static constexpr double kMostExpected = 1e9;  // rows: above, it grows as it goes

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

Columns new_columns(const TextFormat& format, Index leading) {
  if (leading > format.chosen) {
    throw_argument("leading", "no more than the " + std::to_string(format.chosen) + " columns",
                   std::to_string(leading));
  }
  const Index width = leading > 0 ? leading : format.chosen;
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

}  // namespace

TextTable read_columns(TextBlocks& blocks, const TextFormat& format, Index leading, int num_threads,
                       const std::string& name) {
  Columns columns = new_columns(format, leading);
  std::vector<TextRows> parts;
  Index lines = format.lines_before;
  while (!blocks.block().empty()) {
    const std::size_t count = blocks.part_count();
    const std::size_t offset = blocks.offset();
    const auto block_bytes = static_cast<double>(blocks.block().size());
    const char* const begin = blocks.block().data();
    if (parts.size() < count) parts.resize(count);
    blocks.parse_parts(num_threads, [&](std::size_t i, std::string_view text) {
      parts[i].clear();
      parse_rows(text, offset + static_cast<std::size_t>(text.data() - begin), format, parts[i]);
    });
    lines = check_parts(parts, count, lines, name);
    if (columns.empty()) {
      columns.expect(parts, count, 1.0 + static_cast<double>(blocks.bytes_left()) / block_bytes);
    }
    columns.append(parts, count, num_threads);
  }
  if (blocks.too_long()) throw_at(name, lines + 1, "a line of more than 1 MiB");
  TextTable result;
  columns.release(result);
  result.names = chosen_names(format);
  result.separator = format.separator;
  result.decimal = format.decimal;
  return result;
}

}  // namespace bathyal::soundings
