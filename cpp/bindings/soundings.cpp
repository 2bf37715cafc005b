// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "arrays.hpp"
#include "bathyal/base/error.hpp"
#include "bathyal/soundings/text_table.hpp"
#include "bindings.hpp"

namespace bathyal::python {
namespace {

char character(std::string_view name, const std::optional<std::string>& text) {
  if (!text) return '\0';
  if (text->size() != 1) throw_argument(name, "one character or None", "\"" + *text + "\"");
  return text->front();
}

py::object character_or_none(char c) {
  return c == '\0' ? py::object(py::none()) : py::object(py::str(std::string(1, c)));
}

py::list list_of(const std::vector<Values>& columns) {
  py::list result;
  for (const Values& column : columns) result.append(to_numpy(column));
  return result;
}

void bind_text_table(py::module_& module) {
  py::class_<TextTable>(module, "TextTable", "Numbers of a text file, and how it was understood.")
      .def_property_readonly(
          "table",
          [](const TextTable& t) {
            return read_only_array(t.table.data(), {t.rows, t.width}, t.table.owner());
          },
          "(N, C) float64, the first `leading` of the chosen columns, or all of them.")
      .def_property_readonly(
          "extra", [](const TextTable& t) { return list_of(t.extra); },
          "(N,) float64 each: the chosen columns beyond `leading`.")
      .def_readonly("names", &TextTable::names,
                    "One a chosen column; empty when the file has none.")
      .def_property_readonly("separator",
                             [](const TextTable& t) { return std::string(1, t.separator); })
      .def_property_readonly("decimal",
                             [](const TextTable& t) { return std::string(1, t.decimal); })
      .def_readonly("grid", &TextTable::grid, "Whether it was an ESRI ASCII grid (x, y, z).")
      .def("__len__", [](const TextTable& t) { return t.rows; });

  const TextOptions defaults;
  module.def(
      "read_text_table",
      [](const std::filesystem::path& path, const std::optional<std::string>& separator,
         const std::optional<std::string>& decimal, std::vector<std::string> comments,
         int header_lines, int skip_lines, std::vector<std::variant<Index, std::string>> columns,
         Index leading, bool empty_is_nan, int num_threads) {
        TextOptions options;
        options.separator = character("separator", separator);
        options.decimal = character("decimal", decimal);
        options.comments = std::move(comments);
        options.header_lines = header_lines;
        options.skip_lines = skip_lines;
        options.columns = std::move(columns);
        options.leading = leading;
        options.empty_is_nan = empty_is_nan;
        options.num_threads = num_threads;
        const py::gil_scoped_release release;
        return read_text_table(path, options);
      },
      py::arg("path"), py::kw_only(), py::arg("separator") = character_or_none(defaults.separator),
      py::arg("decimal") = character_or_none(defaults.decimal),
      py::arg("comments") = defaults.comments, py::arg("header_lines") = defaults.header_lines,
      py::arg("skip_lines") = defaults.skip_lines, py::arg("columns") = py::tuple(),
      py::arg("leading") = defaults.leading, py::arg("empty_is_nan") = defaults.empty_is_nan,
      py::arg("num_threads") = defaults.num_threads,
      R"(Numbers in columns of a text file, or an ESRI ASCII grid as x, y, z.

Parameters
----------
path : path
separator : " ", ",", ";" or tab, optional
    " " is any run of blanks and tabs. None looks at the file.
decimal : "." or ",", optional
    None takes a comma only where ";" or a tab separates columns and the numbers leave no doubt.
comments : sequence of str
    A line that begins with one of these is skipped, and so is the rest of a line behind a blank
    and one of these.
header_lines : int
    Lines of column names; -1 takes lines without numbers as such.
skip_lines : int
    Lines at the top that are not looked at.
columns : sequence of int or str
    Which columns, by index or name, in this order; empty takes all. The others may hold text.
leading : int
    How many of them lie side by side in ``.table``; each further one is an array of its own in
    ``.extra``. 0: all side by side.
empty_is_nan : bool
    An empty field, NA or null is NaN instead of an error.
num_threads : int
    0: all.

Raises
------
ValueError
    Options that make no sense, or columns that the file lacks.
Error
    With file and line: not readable, no text, no rows, no number, rows of different lengths.
)");
}

}  // namespace

void bind_soundings(py::module_& module) { bind_text_table(module); }

}  // namespace bathyal::python
