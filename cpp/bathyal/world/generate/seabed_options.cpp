// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <string>
#include <utility>

#include "bathyal/base/check.hpp"
#include "bathyal/base/parallel.hpp"
#include "bathyal/world/generate/internal/boulder_field.hpp"
#include "bathyal/world/generate/seabed.hpp"

namespace bathyal {
namespace {

constexpr double kHighestRelief = 20000.0;  // [m]: deeper than any sea
constexpr double kFurthestOption = 1e7;     // [m]

void check_place(std::string_view name, const Vec2& point) {
  for (const double value : point) check_range(name, value, -kFurthestOption, kFurthestOption);
}

void check_relief(const SeabedOptions& o) {
  check_range("relief_rms", o.relief_rms, 0.0, kHighestRelief);
  check_range("relief_exponent", o.relief_exponent, 1.0, 6.0);
  check_positive("relief_shortest", o.relief_shortest);
  if (!(o.relief_longest > o.relief_shortest) ||
      !(o.relief_longest < 65536.0 * o.relief_shortest)) {
    throw_argument("relief_longest", "a wavelength above relief_shortest, below 65536 times it",
                   to_text(o.relief_longest) + " m, and " + to_text(o.relief_shortest));
  }
}

void check_ripples(const SeabedOptions& o) {
  check_range("ripple_height", o.ripple_height, 0.0, kHighestRelief);
  check_range("ripple_wavelength", o.ripple_wavelength, 1e-3, kFurthestOption);
  check_finite("ripple_direction", o.ripple_direction);
  check_range("ripple_asymmetry", o.ripple_asymmetry, 0.0, 0.45);
  check_range("ripple_meander", o.ripple_meander, 0.0, 2.0);
  check_range("ripple_defects", o.ripple_defects, 0.0, 1.0);
  check_range("ripple_cover", o.ripple_cover, 0.0, 1.0);
  check_range("ripple_patch", o.ripple_patch, 1e-3, kFurthestOption);
}

void check_boulders(const SeabedOptions& o) {
  check_not_negative("boulder_density", o.boulder_density);
  check_range("boulder_radius", o.boulder_radius, 1e-2, kHighestRelief);
  check_range("boulder_scour", o.boulder_scour, 0.0, 1.0);
  const double side = generate::BoulderField::side(o.boulder_radius);
  if (o.boulder_density * side * side > generate::BoulderField::kMostInACell) {
    throw_argument("boulder_density", "no more than one in two squares of boulder_radius",
                   to_text(o.boulder_density) + " per m²");
  }
}

void check_edges(const SeabedOptions& o) {
  check_range("trench_depth", o.trench_depth, 0.0, kHighestRelief);
  check_range("trench_width", o.trench_width, 1e-3, kFurthestOption);
  check_not_negative("trench_floor", o.trench_floor);
  if (!(o.trench_floor < o.trench_width)) {
    throw_argument("trench_floor", "less than trench_width, " + to_text(o.trench_width),
                   to_text(o.trench_floor));
  }
  check_finite("trench_direction", o.trench_direction);
  check_place("trench_point", o.trench_point);
  check_range("cliff_height", o.cliff_height, 0.0, kHighestRelief);
  check_range("cliff_run", o.cliff_run, 1e-3, kFurthestOption);
  check_finite("cliff_direction", o.cliff_direction);
  check_place("cliff_point", o.cliff_point);
  check_range("edge_meander", o.edge_meander, 0.0, 1000.0);
}

}  // namespace

void SeabedOptions::check() const {
  check_range("depth", depth, -kHighestRelief, kHighestRelief);
  check_range("slope", slope, 0.0, 1.4);
  check_finite("slope_direction", slope_direction);
  check_relief(*this);
  check_ripples(*this);
  check_boulders(*this);
  check_edges(*this);
  if (scour_points.size() > 10000) {
    throw_argument("scour_points", "10000 at most", std::to_string(scour_points.size()));
  }
  for (const Vec2& point : scour_points) check_place("scour_points", point);
  check_range("scour_depth", scour_depth, 0.0, kHighestRelief);
  check_range("scour_radius", scour_radius, 1e-3, kFurthestOption);
  resolve_threads(num_threads);
}

}  // namespace bathyal
