// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "bathyal/water/water.hpp"
#include "enum_names.hpp"

// What the bindings of the water share: numbers that broadcast, names of formulas, warnings.

namespace bathyal::python {

/// A number where all arguments were numbers, else an array of their common shape.
using NumberOrArray = py::typing::Union<py::float_, py::array>;

/// Arguments of one shape, as numpy broadcasts them.
struct Broadcast {
  std::vector<Values> columns;
  std::vector<py::ssize_t> shape;

  std::size_t size() const { return static_cast<std::size_t>(columns.front().rows()); }
  double at(std::size_t column, std::size_t row) const { return columns[column].data()[row]; }
  /// What the engine computed of each row, in that shape.
  py::object result(std::vector<double> values) const;
};

Broadcast broadcast_arguments(const std::vector<std::pair<std::string_view, py::object>>& given);

/// A formula by its name; TEOS-10 is gsw's, in Python, and has no value of the engine's.
struct SpeedFormula {
  std::string name;
  std::optional<SoundSpeedFormula> formula;  ///< unset: "teos10"
};
SpeedFormula speed_formula_argument(const std::string& name);
std::string formula_name(SoundSpeedFormula formula);

AbsorptionFormula absorption_formula_argument(const std::string& name);
std::string formula_name(AbsorptionFormula formula);

/// What the temperatures [°C] have to be multiplied by for a formula: of IPTS-68 or ITS-90, None
/// the formula's own scale.
double scale_factor(const SpeedFormula& formula, const std::optional<std::string>& scale);

/// Degrees of the border as the engine's radians. \throw std::invalid_argument beyond ±90.
double latitude_argument(double degrees);

/// [m/s] by any formula, of rows that are checked; warns where they are outside its range.
struct SpeedRows {
  std::vector<double> temperature;  ///< on the formula's scale
  std::vector<double> salinity;
  std::vector<double> depth;
  std::vector<double> pressure;
  std::vector<double> latitude;   ///< [rad]
  std::vector<double> longitude;  ///< [deg]; empty: not given
};
std::vector<double> speed_of_rows(const SpeedFormula& formula, const SpeedRows& rows);

/// Warns once for many rows: of the first, and how many; empty texts are inside.
void warn_of_range(const std::string& formula, std::size_t outside, std::size_t rows,
                   const std::string& first);

/// Sound speed by depth of a Water at a time, or of a Profile as it is.
using SpeedSource = py::typing::Union<Water, WaterProfile>;
SpeedProfile speed_source_argument(const py::object& source, double time);

/// All of a water, its columns filled: nothing is computed anew.
py::tuple water_state(const Water& water);
Water water_from_state(const py::tuple& state);

/// (N,) or empty for None.
std::vector<double> column_argument(std::string_view name, const py::object& object);

}  // namespace bathyal::python
