// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>

#include <cmath>
#include <string>

#include "bathyal/base/error.hpp"
#include "bathyal/world/generate/seabed.hpp"
#include "generate.hpp"
#include "generate_seabed_docs.hpp"

namespace bathyal::python {
namespace {

Vec2 size_argument(const py::object& object) {
  const py::array array = array_argument("size", object, "a number, or real numbers of shape (2,)");
  if (array.ndim() != 0) return place_argument("size", object);
  const Values one = values_argument("size", array.attr("reshape")(1));
  return Vec2::Constant(one.data()[0]);
}

/// Calls `bind(function, …)` with what makes the options from keyword-only arguments: the model and
/// the mesh take the same ones.
template <class... Extra>
struct SeabedFunction {
  template <class Bind, class Function, class... Named>
  static void bind(const Bind& bind, const Function& function, const Named&... extra) {
    const SeabedOptions d;
    bind(
        [function](const Extra&... arguments, std::uint64_t seed, double depth, double slope,
                   double slope_direction, double relief_rms, double relief_exponent,
                   double relief_longest, double relief_shortest, double ripple_height,
                   double ripple_wavelength, double ripple_direction, double ripple_asymmetry,
                   double ripple_meander, double ripple_defects, double ripple_cover,
                   double ripple_patch, double boulder_density, double boulder_radius,
                   double boulder_scour, double trench_depth, double trench_width,
                   double trench_floor, double trench_direction, const ArrayLike& trench_point,
                   double cliff_height, double cliff_run, double cliff_direction,
                   const ArrayLike& cliff_point, double edge_meander,
                   const OptionalArray& scour_points, double scour_depth, double scour_radius,
                   int num_threads) {
          SeabedOptions o;
          o.seed = seed;
          o.depth = depth;
          o.slope = slope;
          o.slope_direction = slope_direction;
          o.relief_rms = relief_rms;
          o.relief_exponent = relief_exponent;
          o.relief_longest = relief_longest;
          o.relief_shortest = relief_shortest;
          o.ripple_height = ripple_height;
          o.ripple_wavelength = ripple_wavelength;
          o.ripple_direction = ripple_direction;
          o.ripple_asymmetry = ripple_asymmetry;
          o.ripple_meander = ripple_meander;
          o.ripple_defects = ripple_defects;
          o.ripple_cover = ripple_cover;
          o.ripple_patch = ripple_patch;
          o.boulder_density = boulder_density;
          o.boulder_radius = boulder_radius;
          o.boulder_scour = boulder_scour;
          o.trench_depth = trench_depth;
          o.trench_width = trench_width;
          o.trench_floor = trench_floor;
          o.trench_direction = trench_direction;
          o.trench_point = place_argument("trench_point", trench_point);
          o.cliff_height = cliff_height;
          o.cliff_run = cliff_run;
          o.cliff_direction = cliff_direction;
          o.cliff_point = place_argument("cliff_point", cliff_point);
          o.edge_meander = edge_meander;
          o.scour_points = places_argument("scour_points", scour_points);
          o.scour_depth = scour_depth;
          o.scour_radius = scour_radius;
          o.num_threads = num_threads;
          return function(arguments..., o);
        },
        extra..., py::kw_only(), py::arg("seed") = d.seed, py::arg("depth") = d.depth,
        py::arg("slope") = d.slope, py::arg("slope_direction") = d.slope_direction,
        py::arg("relief_rms") = d.relief_rms, py::arg("relief_exponent") = d.relief_exponent,
        py::arg("relief_longest") = d.relief_longest,
        py::arg("relief_shortest") = d.relief_shortest, py::arg("ripple_height") = d.ripple_height,
        py::arg("ripple_wavelength") = d.ripple_wavelength,
        py::arg("ripple_direction") = d.ripple_direction,
        py::arg("ripple_asymmetry") = d.ripple_asymmetry,
        py::arg("ripple_meander") = d.ripple_meander, py::arg("ripple_defects") = d.ripple_defects,
        py::arg("ripple_cover") = d.ripple_cover, py::arg("ripple_patch") = d.ripple_patch,
        py::arg("boulder_density") = d.boulder_density,
        py::arg("boulder_radius") = d.boulder_radius, py::arg("boulder_scour") = d.boulder_scour,
        py::arg("trench_depth") = d.trench_depth, py::arg("trench_width") = d.trench_width,
        py::arg("trench_floor") = d.trench_floor, py::arg("trench_direction") = d.trench_direction,
        py::arg("trench_point") = py::make_tuple(d.trench_point.x(), d.trench_point.y()),
        py::arg("cliff_height") = d.cliff_height, py::arg("cliff_run") = d.cliff_run,
        py::arg("cliff_direction") = d.cliff_direction,
        py::arg("cliff_point") = py::make_tuple(d.cliff_point.x(), d.cliff_point.y()),
        py::arg("edge_meander") = d.edge_meander, py::arg("scour_points") = py::none(),
        py::arg("scour_depth") = d.scour_depth, py::arg("scour_radius") = d.scour_radius,
        py::arg("num_threads") = d.num_threads);
  }
};

void bind_model(py::module_& module) {
  py::class_<SeabedModel> model(module, "SeabedModel", kSeabedModelDoc);
  SeabedFunction<>::bind(
      [&](const auto& function, const auto&... named) { model.def(py::init(function), named...); },
      [](const SeabedOptions& options) { return SeabedModel(options); });
  model
      .def(
          "height",
          [](const SeabedModel& self, const ArrayLike& x, const ArrayLike& y) {
            const Values east = values_argument("x", x);
            const Values north = values_argument("y", y);
            Values height;
            {
              const py::gil_scoped_release release;
              height = self.height(east, north);
            }
            return to_numpy(height);
          },
          py::arg("x"), py::arg("y"),
          "Heights z [m] at (N,) places x, y [m]: the same bytes as a mesh's vertices there.")
      .def(
          "material",
          [](const SeabedModel& self, const ArrayLike& x, const ArrayLike& y) {
            const Values east = values_argument("x", x);
            const Values north = values_argument("y", y);
            std::vector<std::int16_t> material;
            {
              const py::gil_scoped_release release;
              material = self.material(east, north);
            }
            return to_numpy(std::move(material));
          },
          py::arg("x"), py::arg("y"),
          "Rows of `materials` at (N,) places x, y [m]: boulders and the face of the cliff are "
          "rock, ripples of at least half their height are sand, all else is silt.")
      .def(
          "mesh",
          [](const SeabedModel& self, const ArrayLike& size, double spacing,
             const ArrayLike& origin) {
            const Vec2 sides = size_argument(size);
            const Vec2 middle = place_argument("origin", origin);
            const py::gil_scoped_release release;
            return self.mesh(sides, spacing, middle);
          },
          py::arg("size"), py::arg("spacing"), py::kw_only(),
          py::arg("origin") = py::make_tuple(0.0, 0.0), kSeabedMeshDoc)
      .def_property_readonly_static(
          "materials",
          [](const py::object& /*type*/) {
            return std::vector<std::string>(kSeabedMaterials.begin(), kSeabedMaterials.end());
          },
          "What the numbers of materials mean, as a list of names.")
      .def("__repr__", [](const SeabedModel& self) {
        return "SeabedModel(seed=" + std::to_string(self.options().seed) + ")";
      });
}

}  // namespace

std::vector<Vec2> places_argument(std::string_view name, const py::object& object) {
  std::vector<Vec2> places;
  if (object.is_none()) return places;
  const py::array array = array_argument(name, object, "real numbers of shape (K, 2)");
  if (array.size() == 0) return places;
  const Rows rows = rows_argument(name, array, 2);
  for (Index i = 0; i < rows.table.rows(); ++i) places.emplace_back(rows.table.row(i));
  return places;
}

Eigen::Vector2d place_argument(std::string_view name, const py::object& object) {
  const Values values = values_argument(name, object);
  if (values.rows() != 2) {
    throw_argument(name, "two numbers", std::to_string(values.rows()));
  }
  for (const double value : values.view()) {
    if (!std::isfinite(value)) throw_argument(name, "two finite numbers", to_text(value));
  }
  return {values.data()[0], values.data()[1]};
}

void bind_seabed_model(py::module_& module) {
  bind_model(module);
  SeabedFunction<ArrayLike, double, ArrayLike>::bind(
      [&](const auto& function, const auto&... named) {
        module.def("make_seabed", function, named..., kMakeSeabedDoc);
      },
      [](const ArrayLike& size, double spacing, const ArrayLike& origin,
         const SeabedOptions& options) {
        const Vec2 sides = size_argument(size);
        const Vec2 middle = place_argument("origin", origin);
        const py::gil_scoped_release release;
        return make_seabed(sides, spacing, options, middle);
      },
      py::arg("size"), py::arg("spacing"), py::arg("origin") = py::make_tuple(0.0, 0.0));
  module.def(
      "triangle_material",
      [](const TriangleMesh& mesh) { return to_numpy(triangle_material(mesh.snapshot())); },
      py::arg("mesh"), kTriangleMaterialDoc);
}

}  // namespace bathyal::python
