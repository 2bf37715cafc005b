// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/soundings/internal/ascii_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "bathyal/base/error.hpp"
#include "bathyal/base/parallel.hpp"
#include "bathyal/soundings/internal/growing_array.hpp"
#include "bathyal/soundings/internal/text_format.hpp"

namespace bathyal::soundings {
namespace {

struct GridHeader {
  std::size_t columns = 0;
  std::size_t rows = 0;
  double west = 0.0;   ///< x of the first column's centres
  double south = 0.0;  ///< y of the last row's centres
  double dx = 0.0;
  double dy = 0.0;
  double no_data = -9999.0;
  std::size_t bytes = 0;  ///< length of the header
  Index lines = 0;

  bool has_value(double z) const { return z != no_data && !std::isnan(z); }
};

/// Numbers of one part, and how many of them are values.
struct alignas(kPartAlignment) GridPart {
  GrowingArray<double> numbers;
  std::size_t values = 0;
  Index lines = 0;
  std::optional<std::string> failure;
};

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c + ('a' - 'A')) : c;
  });
  return result;
}

/// The header's words and numbers, up to the first line that begins with a number.
std::map<std::string, double> header_words(std::string_view text, const std::string& name,
                                           GridHeader& header) {
  std::map<std::string, double> words;
  std::string_view rest = text;
  std::vector<std::string_view> fields;
  const TextFormat format;
  double value = 0.0;
  while (!rest.empty()) {
    header.bytes = text.size() - rest.size();
    std::string_view line = rest.substr(0, 1000);  // a row of numbers may be of any length
    line = take_line(line);
    split_fields(line, format, 0, fields);
    if (!fields.empty() && field_value(fields.front(), format, value)) break;
    if (!fields.empty()) {
      if (fields.size() != 2 || !field_value(fields[1], format, value)) {
        throw_at(name, header.lines + 1,
                 "expected a word of a grid's header and a number, got \"" + printable(line, 100) +
                     "\"");
      }
      words[lower(fields[0])] = value;
    }
    take_line(rest);
    ++header.lines;
  }
  return words;
}

std::optional<double> find(const std::map<std::string, double>& words,
                           std::initializer_list<const char*> keys) {
  for (const char* key : keys) {
    if (const auto found = words.find(key); found != words.end()) return found->second;
  }
  return std::nullopt;
}

double require(std::optional<double> value, const char* what, const std::string& name) {
  if (!value) throw Error(name + ": the grid's header lacks " + what);
  if (!std::isfinite(*value)) throw Error(name + ": the grid's " + what + " is not finite");
  return *value;
}

std::size_t require_count(std::optional<double> value, const char* what, const std::string& name) {
  const double count = require(value, what, name);
  if (!(count >= 1.0 && count <= 2147483647.0 && count == std::floor(count))) {
    throw Error(name + ": the grid's " + what + " is " + to_text(count) +
                ", no whole number from 1 to 2147483647");
  }
  return static_cast<std::size_t>(count);
}

GridHeader read_grid_header(std::string_view text, const std::string& name) {
  GridHeader header;
  const auto words = header_words(text, name, header);
  const auto size = find(words, {"cellsize"});
  header.columns = require_count(find(words, {"ncols"}), "ncols", name);
  header.rows = require_count(find(words, {"nrows"}), "nrows", name);
  header.dx = require(size ? size : find(words, {"dx"}), "cellsize", name);
  header.dy = require(size ? size : find(words, {"dy"}), "cellsize", name);
  if (!(header.dx > 0.0 && header.dy > 0.0)) {
    throw Error(name + ": the grid's cellsize is not above 0");
  }
  const auto west = find(words, {"xllcenter", "xllcentre"});
  const auto south = find(words, {"yllcenter", "yllcentre"});
  header.west = west ? require(west, "xllcenter", name)
                     : require(find(words, {"xllcorner"}), "xllcorner", name) + 0.5 * header.dx;
  header.south = south ? require(south, "yllcenter", name)
                       : require(find(words, {"yllcorner"}), "yllcorner", name) + 0.5 * header.dy;
  header.no_data = find(words, {"nodata_value", "nodata"}).value_or(header.no_data);
  return header;
}

void parse_numbers(std::string_view text, const GridHeader& header, GridPart& part) {
  const TextFormat format;
  part.numbers.clear();
  part.values = 0;
  part.lines = 0;
  part.failure.reset();
  const char* p = text.data();
  const char* const end = p + text.size();
  while (true) {
    while (p < end && (*p == ' ' || *p == '\t' || *p == '\n' || *p == '\r')) {
      part.lines += *p++ == '\n' ? 1 : 0;
    }
    if (p == end) return;
    const char* word_end = p;
    while (word_end<end&& static_cast<unsigned char>(*word_end)> ' ') ++word_end;
    const std::string_view word(p, static_cast<std::size_t>(word_end - p));
    double value = 0.0;
    if (!field_value(word, format, value)) {
      part.failure =
          "expected a number, got \"" +
          printable(word.empty() ? text.substr(static_cast<std::size_t>(p - text.data()), 1)
                                 : word) +
          "\"";
      return;
    }
    part.numbers.push_back(value);
    part.values += header.has_value(value) ? 1 : 0;
    p = word_end;
  }
}

/// Writes the points of the part's values; its first number is that of cell `cell`.
void write_points(const GridPart& part, const GridHeader& header, std::size_t cell, double* to) {
  std::size_t row = cell / header.columns;
  std::size_t column = cell % header.columns;
  for (std::size_t i = 0; i < part.numbers.size(); ++i) {
    const double z = part.numbers.data()[i];
    if (header.has_value(z)) {
      *to++ = header.west + static_cast<double>(column) * header.dx;
      *to++ = header.south + static_cast<double>(header.rows - 1 - row) * header.dy;
      *to++ = z;
    }
    if (++column == header.columns) {
      column = 0;
      ++row;
    }
  }
}

std::string cell_text(const GridHeader& header) {
  return std::to_string(header.columns) + " × " + std::to_string(header.rows) + " cells";
}

}  // namespace

bool is_ascii_grid(std::string_view head) {
  const std::size_t begin = head.find_first_not_of(" \t\r\n");
  return begin != std::string_view::npos && lower(head.substr(begin, 5)) == "ncols" &&
         head.size() > begin + 5 && (head[begin + 5] == ' ' || head[begin + 5] == '\t');
}

AsciiGrid read_grid_blocks(TextBlocks& blocks, int num_threads, const std::string& name) {
  blocks.start(TextCut::kBlank);
  const GridHeader header = read_grid_header(blocks.block(), name);
  blocks.skip(header.bytes);
  const std::size_t cells = header.columns * header.rows;
  GrowingArray<double> points;
  std::vector<GridPart> parts;
  std::size_t cell = 0;
  Index lines = header.lines;
  while (!blocks.block().empty()) {
    const std::size_t count = blocks.part_count();
    if (parts.size() < count) parts.resize(count);
    blocks.parse_parts(num_threads, [&](std::size_t i, std::string_view text) {
      parse_numbers(text, header, parts[i]);
    });
    std::vector<std::size_t> first_cell(count + 1, cell);
    std::vector<std::size_t> first_point(count + 1, 0);
    for (std::size_t i = 0; i < count; ++i) {
      lines += parts[i].lines;
      if (parts[i].failure) throw_at(name, lines + 1, *parts[i].failure);
      first_cell[i + 1] = first_cell[i] + parts[i].numbers.size();
      first_point[i + 1] = first_point[i] + parts[i].values;
    }
    cell = first_cell[count];
    if (cell > cells) throw_at(name, lines, "more numbers than the " + cell_text(header));
    double* const to = points.room_for(3 * first_point[count]);
    parallel_for(count, 1, num_threads, [&](std::size_t i, std::size_t) {
      write_points(parts[i], header, first_cell[i], to + 3 * first_point[i]);
    });
    points.commit(3 * first_point[count]);
  }
  if (blocks.too_long()) throw_at(name, lines + 1, "a word of more than 1 MiB");
  if (cell < cells) {
    throw Error(name + ": " + std::to_string(cell) + " numbers for " + cell_text(header));
  }
  if (points.size() == 0) throw Error(name + ": no cell of the grid has a value");
  AsciiGrid grid;
  const auto count = static_cast<Index>(points.size() / 3);
  const std::shared_ptr<const double> data = points.release();
  grid.points = Points(data.get(), count, data);
  grid.columns = static_cast<Index>(header.columns);
  grid.rows = static_cast<Index>(header.rows);
  grid.without_value = static_cast<Index>(cells) - count;
  return grid;
}

}  // namespace bathyal::soundings
