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
#include "bathyal/soundings/pcd.hpp"
#include "bathyal/soundings/survey.hpp"
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

void bind_files(py::module_& module) {
  module.def(
      "read_pcd",
      [](const std::filesystem::path& path, int num_threads) {
        const py::gil_scoped_release release;
        return read_pcd(path, num_threads);
      },
      py::arg("path"), py::kw_only(), py::arg("num_threads") = 0,
      R"(The point cloud of a .pcd file: ascii, binary or binary_compressed.

Fields beside x, y, z become attributes; `rgb` and `rgba` are taken apart into red, green, blue.
)");

  const WriteXyzOptions defaults;
  module.def(
      "write_xyz",
      [](const std::filesystem::path& path, const PointCloud& cloud, int decimals,
         const std::string& separator, bool header, std::vector<std::string> attributes,
         int num_threads) {
        WriteXyzOptions options;
        options.decimals = decimals;
        options.separator = character("separator", separator);
        options.header = header;
        options.attributes = std::move(attributes);
        options.num_threads = num_threads;
        const py::gil_scoped_release release;
        write_xyz(path, cloud, options);
      },
      py::arg("path"), py::arg("cloud"), py::kw_only(), py::arg("decimals") = defaults.decimals,
      py::arg("separator") = std::string(1, defaults.separator),
      py::arg("header") = defaults.header, py::arg("attributes") = defaults.attributes,
      py::arg("num_threads") = defaults.num_threads,
      R"(Write x y z and the named attributes as text, one point a line.

`decimals` of -1 writes the shortest text that reads back as the same number. Writes in place: write
aside and rename.
)");
}

/// Calls `bind(name, function)` with what makes the options from keyword-only arguments: every
/// function about a generated survey takes the same ones.
template <class... Extra>
struct SurveyFunction {
  template <class Function, class... Named>
  static void bind(py::module_& module, const char* name, const Function& function, const char* doc,
                   const Named&... extra) {
    const SurveyOptions d;
    module.def(
        name,
        [function](const Extra&... arguments, std::uint64_t seed, const py::object& origin,
                   double length, double width, double wave_height, double wave_length,
                   double ripple_height, double roughness, int boulders, double boulder_radius,
                   double trench_depth, double trench_width, int lines, double altitude,
                   double opening, int beams, double ping_spacing, double lost_width,
                   double range_noise, double range_noise_rate, double angle_noise,
                   double spike_fraction, int num_threads) {
          SurveyOptions options;
          options.seed = seed;
          options.origin = vector_argument("origin", origin);
          options.length = length;
          options.width = width;
          options.wave_height = wave_height;
          options.wave_length = wave_length;
          options.ripple_height = ripple_height;
          options.roughness = roughness;
          options.boulders = boulders;
          options.boulder_radius = boulder_radius;
          options.trench_depth = trench_depth;
          options.trench_width = trench_width;
          options.lines = lines;
          options.altitude = altitude;
          options.opening = opening;
          options.beams = beams;
          options.ping_spacing = ping_spacing;
          options.lost_width = lost_width;
          options.range_noise = range_noise;
          options.range_noise_rate = range_noise_rate;
          options.angle_noise = angle_noise;
          options.spike_fraction = spike_fraction;
          options.num_threads = num_threads;
          return function(arguments..., options);
        },
        extra..., py::kw_only(), py::arg("seed") = d.seed,
        py::arg("origin") = py::make_tuple(d.origin.x(), d.origin.y(), d.origin.z()),
        py::arg("length") = d.length, py::arg("width") = d.width,
        py::arg("wave_height") = d.wave_height, py::arg("wave_length") = d.wave_length,
        py::arg("ripple_height") = d.ripple_height, py::arg("roughness") = d.roughness,
        py::arg("boulders") = d.boulders, py::arg("boulder_radius") = d.boulder_radius,
        py::arg("trench_depth") = d.trench_depth, py::arg("trench_width") = d.trench_width,
        py::arg("lines") = d.lines, py::arg("altitude") = d.altitude,
        py::arg("opening") = d.opening, py::arg("beams") = d.beams,
        py::arg("ping_spacing") = d.ping_spacing, py::arg("lost_width") = d.lost_width,
        py::arg("range_noise") = d.range_noise, py::arg("range_noise_rate") = d.range_noise_rate,
        py::arg("angle_noise") = d.angle_noise, py::arg("spike_fraction") = d.spike_fraction,
        py::arg("num_threads") = d.num_threads, doc);
  }
};

void bind_survey(py::module_& module) {
  SurveyFunction<>::bind(
      module, "generate_survey",
      [](const SurveyOptions& options) {
        const py::gil_scoped_release release;
        return generate_survey(options);
      },
      R"(A multibeam survey that never was, over a bottom that is known exactly.

Sand waves with ripples, boulders with scour and shadow, a trench, a stripe of lost pings, noise that
grows with range, and the uneven spacing of beams at equal angles. The same seed and options give the
same numbers, for any number of threads. `survey_height` gives the true height.

Parameters
----------
seed : int
origin : (3,) array
    South-west corner and the bottom's mean height [m].
length, width : float
    Along (x) and across (y) the survey lines [m].
wave_height, wave_length : float
    Sand waves, trough to crest and crest to crest [m].
ripple_height, roughness : float
    Ripples, trough to crest, and the rms of a slow undulation [m].
boulders : int
boulder_radius : float
    Of the largest [m].
trench_depth, trench_width : float
    [m]; a depth of 0 for none.
lines, beams : int
    Survey lines over the width, and beams a ping.
altitude : float
    Of the sounder above the mean height [m].
opening : float
    Of the fan of beams [rad].
ping_spacing : float
    Along the line [m].
lost_width : float
    Length of the stripe of pings that the first line lost [m].
range_noise, range_noise_rate, angle_noise : float
    Standard deviation of a range, constant part [m] and growth [m/m], and of a beam's angle [rad].
spike_fraction : float
    Of soundings that are echoes from fish above the bottom, 0 to 1.
num_threads : int
    0: all.

Returns
-------
PointCloud
    With the attributes ``uncertainty``, the standard deviation of z [m], and ``intensity`` [dB].

Raises
------
ValueError
    An option out of its range, or a sounder that would touch the bottom.

Examples
--------
>>> import bathyal
>>> cloud = bathyal.generate_survey(seed=1, length=6.0, beams=64)
>>> cloud
PointCloud(4416 points)
>>> sorted(cloud.attributes)
['intensity', 'uncertainty']
)");
  SurveyFunction<py::object, py::object>::bind(
      module, "survey_height",
      [](const py::object& x, const py::object& y, const SurveyOptions& options) {
        const Values east = values_argument("x", x);
        const Values north = values_argument("y", y);
        Values height;
        {
          const py::gil_scoped_release release;
          height = survey_height(east, north, options);
        }
        return to_numpy(height);
      },
      R"(True height of the bottom under a generated survey.

Parameters
----------
x, y : (N,) arrays
    Survey coordinates [m].
seed, origin, length, …
    As given to generate_survey.

Returns
-------
(N,) array
    [m]

Examples
--------
>>> import bathyal
>>> flat = dict(wave_height=0, ripple_height=0, roughness=0, boulders=0, trench_depth=0)
>>> bathyal.survey_height([431210.0], [6172660.0], **flat)
array([-38.])
)",
      py::arg("x"), py::arg("y"));
}

}  // namespace

void bind_soundings(py::module_& module) {
  bind_text_table(module);
  bind_files(module);
  bind_survey(module);
}

}  // namespace bathyal::python
