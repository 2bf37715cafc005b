// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>

#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "bathyal/base/check.hpp"
#include "bathyal/base/error.hpp"
#include "bathyal/sonar/processing/bottom_track.hpp"
#include "bathyal/sonar/processing/mosaic.hpp"
#include "bindings.hpp"
#include "enum_names.hpp"

namespace bathyal::python {
namespace {

constexpr const char* kBottomDoc =
    R"(Sample of the bottom's first return in each row; −1 where there is none.

`bathyal.SonarRecord.track_bottom` is the way to it.

Parameters
----------
power : (P, beams, samples) array
    Near to far; rows may end in NaN.
method : str
    "likelihood" or "threshold".
first_sample : int
    Nothing nearer is taken for the bottom.
threshold_db : float
    Of "threshold", above the water before it.

Returns
-------
(P, beams) array of int64

Raises
------
ValueError
    For wrong shapes, or a method that is neither.
)";

constexpr const char* kGroundDoc = R"(Rows laid on a level bottom.

Parameters
----------
power : (P, beams, samples) array
sample_length : float
    [m]
first : (P, beams) array
    Slant range of the first return [m]; NaN gives a row of NaN.
spacing : float
    Of the bins on the ground [m].

Returns
-------
(P, beams, bins) array of float32
    Mean power of what came from each bin; bin k is from k to k + 1 times the spacing.

Raises
------
ValueError
    For wrong shapes, or a spacing that is not above 0 or gives more than 4·10⁸ bins.
)";

constexpr const char* kMosaicDoc = R"(An image of the bottom from above, of rows on the ground.

Parameters
----------
power : (P, beams, bins) array
bin_length : float
    [m]
sides : list of str
    "port" or "starboard", of each beam.
place : (P, 3) array
    x, y [m] of each row's middle, and the heading clockwise from y [rad]; NaN leaves a ping out.
spacing : float
    Of the cells [m].
gap : float
    The widest between neighbouring pings that is filled [m].

Returns
-------
(rows, columns) array of float32, west, north, left_out
    North up; outer corner of the first cell [m]; pings without a place.

Raises
------
ValueError
    For wrong shapes, or a spacing that is not above 0 or gives more than 4·10⁸ cells.
bathyal.Error
    Where no ping has a place.
)";

using Power = py::array_t<float, py::array::c_style | py::array::forcecast>;

Power power_argument(const ArrayLike& object) {
  const std::string expected = "real numbers of shape (pings, beams, samples)";
  const py::array given = array_argument("power", object, expected);
  if (given.ndim() != 3) {
    throw_argument("power", expected, py::repr(given.attr("shape")).cast<std::string>());
  }
  return Power(given);
}

SidescanRows rows_of(const Power& power, double sample_length) {
  return {{power.data(), static_cast<std::size_t>(power.size())},
          power.shape(0),
          power.shape(1),
          power.shape(2),
          sample_length};
}

const EnumNames<BottomPicker> kPickers{{"likelihood", BottomPicker::kLikelihood},
                                       {"threshold", BottomPicker::kThreshold}};
const EnumNames<Side> kSides{{"port", Side::kPort}, {"starboard", Side::kStarboard}};

py::array bottom_of(const ArrayLike& object, const std::string& method, std::int64_t first_sample,
                    double threshold_db) {
  BottomTrackOptions options;
  options.picker = enum_argument("method", method, kPickers);
  options.first_sample = first_sample;
  options.threshold_db = threshold_db;
  const Power power = power_argument(object);
  const SidescanRows rows = rows_of(power, 1.0);
  std::vector<std::int64_t> found(static_cast<std::size_t>(rows.pings * rows.beams));
  {
    const py::gil_scoped_release unlocked;
    for (std::int64_t b = 0; b < rows.beams && rows.pings > 0; ++b) {
      const auto start = static_cast<std::size_t>(b * rows.samples);
      const std::vector<std::int64_t> picks = track_bottom(
          rows.power.subspan(start), rows.pings, rows.samples, rows.beams * rows.samples, options);
      for (std::int64_t p = 0; p < rows.pings; ++p) {
        found[static_cast<std::size_t>(p * rows.beams + b)] = picks[static_cast<std::size_t>(p)];
      }
    }
  }
  return to_numpy(std::move(found), {rows.beams});
}

py::array ground_of(const ArrayLike& object, double sample_length, const ArrayLike& first,
                    double spacing) {
  const Power power = power_argument(object);
  const SidescanRows rows = rows_of(power, sample_length);
  const auto ranges = table_argument("first", first, rows.beams);
  GroundRows ground;
  {
    const py::gil_scoped_release unlocked;
    ground = to_ground(rows, {ranges.data(), static_cast<std::size_t>(ranges.size())}, spacing);
  }
  if (ground.bins == 0) return Power(std::vector<py::ssize_t>{rows.pings, rows.beams, 0});
  return to_numpy(std::move(ground.power), {rows.beams, ground.bins});
}

py::tuple mosaic_from(const ArrayLike& object, double bin_length,
                      const std::vector<std::string>& sides, const ArrayLike& place, double spacing,
                      double gap) {
  const Power power = power_argument(object);
  const SidescanRows rows = rows_of(power, bin_length);
  const auto table = table_argument("place", place, 3);
  std::vector<RowPlace> places;
  for (Index i = 0; i < table.rows(); ++i) {
    places.push_back({table(i, 0), table(i, 1), table(i, 2)});
  }
  std::vector<Side> ways;
  for (const std::string& side : sides) ways.push_back(enum_argument("sides", side, kSides));
  Mosaic mosaic;
  {
    const py::gil_scoped_release unlocked;
    mosaic = mosaic_of(rows, ways, places, {spacing, gap});
  }
  return py::make_tuple(to_numpy(std::move(mosaic.power), {mosaic.columns}), mosaic.west,
                        mosaic.north, mosaic.left_out);
}

}  // namespace

void bind_sidescan(py::module_& module) {
  module.def("sidescan_bottom", &bottom_of, py::arg("power"), py::kw_only(),
             py::arg("method") = "likelihood", py::arg("first_sample") = 0,
             py::arg("threshold_db") = 6.0, kBottomDoc);
  module.def("sidescan_ground", &ground_of, py::arg("power"), py::kw_only(),
             py::arg("sample_length"), py::arg("first"), py::arg("spacing"), kGroundDoc);
  module.def("sidescan_mosaic", &mosaic_from, py::arg("power"), py::kw_only(),
             py::arg("bin_length"), py::arg("sides"), py::arg("place"), py::arg("spacing"),
             py::arg("gap") = 1.0, kMosaicDoc);
}

}  // namespace bathyal::python
