// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "bathyal/geometry/shared_array.hpp"

namespace bathyal {

/// How a text of columns is to be read.
struct TextOptions {
  /// Between columns: ' ' (any run of blanks and tabs), ',', ';' or '\t'; 0 looks at the file.
  char separator = '\0';
  /// '.' or ','; 0 takes a comma only where ';' or a tab separates columns and the numbers can mean
  /// nothing else ("1,234" alone may be a thousand: that is an Error which names this option).
  char decimal = '\0';
  /// A line that begins with one of these, and the rest of a line after a blank and one of these,
  /// is a comment. ";" counts only where it does not separate columns.
  std::vector<std::string> comments = {"#", "//", "%", "!", ";"};
  int header_lines =
      -1;              ///< lines of column names, comments not counted; −1: those without numbers
  int skip_lines = 0;  ///< lines at the top that are not looked at, 0 or more
  /// Which columns, by index from 0 or by name, in the order wanted; empty: all. The others may
  /// hold text.
  std::vector<std::variant<Index, std::string>> columns;
  /// How many of the chosen columns lie side by side in `TextTable::table`; each further one is an
  /// array of its own. 0: all side by side.
  Index leading = 0;
  bool empty_is_nan = false;  ///< an empty field, NA or null is NaN; otherwise an Error
  int num_threads = 0;        ///< 0: all

  /// \throw std::invalid_argument
  void check() const;
};

/// What was read, and how the file was understood.
struct TextTable {
  Index rows = 0;
  Index width = 0;                 ///< columns of `table`
  Values table;                    ///< (rows · width,) numbers, row by row
  std::vector<Values> extra;       ///< (rows,) numbers each: chosen columns beyond `leading`
  std::vector<std::string> names;  ///< one a chosen column, or none where the file has no names
  char separator = ' ';
  char decimal = '.';
  bool grid = false;  ///< an ESRI ASCII grid: columns x, y, z
};

/// Reads numbers in columns (.xyz .txt .csv .asc), or an ESRI ASCII grid, recognised by its
/// first word and converted to x, y, z of every cell that has a value.
///
/// The file is read in blocks of 2 MiB, which are parsed in parallel; besides the result
/// no more than about 20 MB are held, whatever the file's size. Lines may end in LF, CRLF or CR; a
/// byte order mark, blank lines, quotes around a field, a plus sign and one separator at the end of
/// a line are allowed; nan and inf are numbers. Values are correctly rounded. The result does not
/// depend on num_threads.
///
/// \throw std::invalid_argument for options that make no sense or columns that the file lacks.
/// \throw Error that names the file, and the line where there is one: a file that cannot be opened,
/// is no text, holds no row, has a field that is no number, rows of different lengths, or a line
/// above 1 MiB.
TextTable read_text_table(const std::filesystem::path& path, const TextOptions& options = {});

/// The same for text in memory, called `name` in messages.
TextTable parse_text_table(std::string_view text, const TextOptions& options = {},
                           const std::string& name = "text");

}  // namespace bathyal
