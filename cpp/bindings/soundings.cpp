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
#include "bathyal/soundings/clean_cloud.hpp"
#include "bathyal/soundings/file_limit.hpp"
#include "bathyal/soundings/pcd.hpp"
#include "bathyal/soundings/text_table.hpp"
#include "bathyal/soundings/write_xyz.hpp"
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
      .def_property_readonly(
          "separator", [](const TextTable& t) { return std::string(1, t.separator); },
          "Character between two columns.")
      .def_property_readonly(
          "decimal", [](const TextTable& t) { return std::string(1, t.decimal); },
          "Decimal point or comma.")
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
    None takes a comma only where ";" or a tab separates columns and no number could mean thousands.
comments : sequence of str
    A line that begins with one of these is skipped, and so is the rest of a line after a blank
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

void bind_files(py::module_& module) {
  module.def("check_bytes", &check_bytes, py::arg("what"), py::arg("bytes"),
             R"(Raise `Error` where `bytes` are more than one file may take in memory.

The limit is BATHYAL_MOST_BYTES of the environment, 4 GiB where that is not set.
)");

  module.def(
      "read_pcd",
      [](const std::filesystem::path& path, int num_threads) {
        const py::gil_scoped_release release;
        return read_pcd(path, num_threads);
      },
      py::arg("path"), py::kw_only(), py::arg("num_threads") = 0,
      R"(The point cloud of a .pcd file: ascii, binary or binary_compressed.

Fields other than x, y, z become attributes; `rgb` and `rgba` are taken apart into red, green, blue.
)");

  const WriteXyzOptions defaults;
  module.def(
      "write_xyz",
      [](const std::filesystem::path& path, const PointCloud& cloud, int decimals,
         const std::string& separator, std::string preamble, bool header,
         std::vector<std::string> attributes, int num_threads) {
        WriteXyzOptions options;
        options.decimals = decimals;
        options.separator = character("separator", separator);
        options.preamble = std::move(preamble);
        options.header = header;
        options.attributes = std::move(attributes);
        options.num_threads = num_threads;
        const py::gil_scoped_release release;
        write_xyz(path, cloud.snapshot(), options);
      },
      py::arg("path"), py::arg("cloud"), py::kw_only(), py::arg("decimals") = defaults.decimals,
      py::arg("separator") = std::string(1, defaults.separator),
      py::arg("preamble") = defaults.preamble, py::arg("header") = defaults.header,
      py::arg("attributes") = defaults.attributes, py::arg("num_threads") = defaults.num_threads,
      R"(Write x y z and the named attributes as text, one point a line.

`decimals` of -1 writes the shortest text that reads back as the same number; `preamble` goes above
everything else, unchanged. Writes in place: write aside and rename.
)");
}

SamePlace same_place_argument(const std::string& text) {
  if (text == "keep") return SamePlace::kKeep;
  if (text == "shallowest") return SamePlace::kShallowest;
  if (text == "deepest") return SamePlace::kDeepest;
  throw_argument("same_place", "\"keep\", \"shallowest\" or \"deepest\"", "\"" + text + "\"");
}

std::string rule_text(SamePlace rule) {
  switch (rule) {
    case SamePlace::kShallowest:
      return "shallowest";
    case SamePlace::kDeepest:
      return "deepest";
    default:
      return "keep";
  }
}

void bind_clean_results(py::module_& module) {
  py::class_<CleanReport>(
      module, "CleanReport",
      "How many soundings each step of clean_cloud dropped; str() is for people.")
      .def_readonly("before", &CleanReport::before, "Soundings given.")
      .def_readonly("not_finite", &CleanReport::not_finite, "x, y or z is NaN or infinite.")
      .def_readonly("duplicates", &CleanReport::duplicates, "Equal x, y and z, all but one.")
      .def_readonly("same_place", &CleanReport::same_place,
                    "Share x, y with a sounding of another z; counted, dropped or not.")
      .def_readonly("same_place_dropped", &CleanReport::same_place_dropped,
                    "Dropped as another depth at the same x, y.")
      .def_readonly("spikes", &CleanReport::spikes, "Dropped as spikes.")
      .def_readonly("outliers", &CleanReport::outliers, "Dropped as outliers.")
      .def_readonly("thinned", &CleanReport::thinned, "By voxels.")
      .def_readonly("after", &CleanReport::after, "Soundings that remain.")
      .def(
          "as_dict",
          [](const CleanReport& r) {
            py::dict result;
            for (const auto& [name, count] : {std::pair{"before", r.before},
                                              {"not_finite", r.not_finite},
                                              {"duplicates", r.duplicates},
                                              {"same_place", r.same_place},
                                              {"same_place_dropped", r.same_place_dropped},
                                              {"spikes", r.spikes},
                                              {"outliers", r.outliers},
                                              {"thinned", r.thinned},
                                              {"after", r.after}}) {
              result[name] = count;
            }
            return result;
          },
          "Name → count, in the order of the steps.")
      .def("__str__", &CleanReport::text)
      .def("__repr__", [](const CleanReport& r) {
        return "CleanReport(before=" + std::to_string(r.before) +
               ", after=" + std::to_string(r.after) + ")";
      });
  py::class_<CleanResult>(module, "CleanResult", "What clean_cloud returns.")
      .def_readonly("cloud", &CleanResult::cloud, "PointCloud of what stayed.")
      .def_readonly("report", &CleanResult::report, "CleanReport: how many went, and why.")
      .def_property_readonly(
          "rows", [](const CleanResult& r) { return to_numpy(r.rows); },
          "(N,) int32: which row of the given cloud each sounding was.");
}

void bind_clean(py::module_& module) {
  bind_clean_results(module);
  const CleanOptions d;
  module.def(
      "clean_cloud",
      [](const CloudLike& cloud, const std::string& same_place, double spike_sigma,
         double spike_height, int spike_neighbours, double outlier_sigma, int outlier_neighbours,
         double voxel, int num_threads) {
        CleanOptions options;
        options.same_place = same_place_argument(same_place);
        options.spike_sigma = spike_sigma;
        options.spike_height = spike_height;
        options.spike_neighbours = spike_neighbours;
        options.outlier_sigma = outlier_sigma;
        options.outlier_neighbours = outlier_neighbours;
        options.voxel = voxel;
        options.num_threads = num_threads;
        const PointCloud input = cloud_argument(cloud);
        const py::gil_scoped_release release;
        return clean_cloud(input, options);
      },
      py::arg("cloud"), py::kw_only(), py::arg("same_place") = rule_text(d.same_place),
      py::arg("spike_sigma") = d.spike_sigma, py::arg("spike_height") = d.spike_height,
      py::arg("spike_neighbours") = d.spike_neighbours, py::arg("outlier_sigma") = d.outlier_sigma,
      py::arg("outlier_neighbours") = d.outlier_neighbours, py::arg("voxel") = d.voxel,
      py::arg("num_threads") = d.num_threads,
      R"(Drop points that are no soundings and, on request, redundant ones and outliers; report how many.

Points that are not finite go first, then exact duplicates. The other steps run only on request, in
the order of the parameters. Attributes and datum follow; rows keep their order, and which positions
stay does not depend on it.

Parameters
----------
cloud : PointCloud or (N, 3) array
same_place : "keep", "shallowest" or "deepest"
    Which of several soundings with equal x, y and different z stays. They are counted in any case.
spike_sigma, spike_height, spike_neighbours : float, float, int
    Drop soundings further from the median height of their neighbours in plan than `spike_sigma`
    robust standard deviations (of the neighbours or of the whole cloud, whichever is larger) and
    than `spike_height` [m]. 0 does not look for spikes.
outlier_sigma, outlier_neighbours : float, int
    Drop soundings whose mean distance to their neighbours in space is above that of all by more than
    `outlier_sigma` standard deviations (Rusu et al. 2008). 0 does not look for outliers.
voxel : float
    Of all soundings in a cube of this edge [m] keep the one nearest to their centroid: what stays
    was measured. 0 does not thin.
num_threads : int
    0: all.

Returns
-------
CleanResult
    ``.cloud``, ``.report`` and ``.rows``.

Raises
------
ValueError
    An option out of its range.

Examples
--------
>>> import bathyal
>>> cloud = bathyal.PointCloud([[0, 0, -5], [0, 0, -5], [1, 0, float("nan")], [2, 0, -5.1]])
>>> result = bathyal.clean_cloud(cloud)
>>> result.cloud
PointCloud(2 points)
>>> print(result.report)
2 of 4 soundings kept
  1 dropped: a coordinate is not finite
  1 dropped: exact duplicates (equal x, y, z)
)");
}

}  // namespace

void bind_soundings(py::module_& module) {
  bind_text_table(module);
  bind_files(module);
  bind_clean(module);
}

}  // namespace bathyal::python
