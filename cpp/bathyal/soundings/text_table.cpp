// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/soundings/text_table.hpp"

#include "bathyal/base/error.hpp"
#include "bathyal/base/parallel.hpp"
#include "bathyal/soundings/internal/ascii_grid.hpp"
#include "bathyal/soundings/internal/text_blocks.hpp"
#include "bathyal/soundings/internal/text_columns.hpp"

namespace bathyal {
namespace {

using namespace soundings;

TextTable read_rows(TextBlocks& blocks, const TextOptions& options, const std::string& name) {
  blocks.start(TextCut::kLine);
  if (blocks.too_long()) throw Error(name + ":1: a line of more than 1 MiB");
  const TextFormat format = detect_format(blocks.block(), options, name);
  blocks.skip(format.begin);
  return read_columns(blocks, format, options.leading, options.num_threads, name);
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
