// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "bathyal/base/error.hpp"
#include "bathyal/world/generate/pipeline.hpp"
#include "bindings.hpp"
#include "generate.hpp"
#include "generate_pipeline_docs.hpp"

namespace bathyal::python {
namespace {

using OptionalScene = py::typing::Optional<Scene>;

std::vector<double> burial_argument(const py::object& object) {
  const py::array array = array_argument("burial", object, "a number or (K,) real numbers");
  const Values values =
      values_argument("burial", array.ndim() == 0 ? array.attr("reshape")(1) : py::object(array));
  return {values.data(), values.data() + values.rows()};
}

std::vector<std::array<double, 2>> spans_argument(const py::object& object) {
  std::vector<std::array<double, 2>> spans;
  for (const Eigen::Vector2d& span : places_argument("spans", object)) {
    spans.push_back({span.x(), span.y()});
  }
  return spans;
}

/// The route by its columns: (K, 2) with a terrain, (K, 3) without.
template <class OnTerrain, class Free>
Pipeline along_route(const py::object& route, const py::object& terrain, const OnTerrain& laid,
                     const Free& free) {
  const bool flat = !terrain.is_none();
  const std::string expected = flat ? "real numbers of shape (K, 2), heights are the terrain's"
                                    : "real numbers of shape (K, 3), there is no terrain";
  const py::array array = array_argument("route", route, expected);
  if (array.ndim() != 2 || array.shape(1) != (flat ? 2 : 3)) {
    throw_argument("route", expected, "shape " + std::string(py::str(array.attr("shape"))));
  }
  if (flat) {
    if (!py::isinstance<Scene>(terrain)) {
      throw_argument("terrain", "a Scene or None",
                     std::string(py::str(py::type::of(terrain).attr("__name__"))));
    }
    const std::vector<Vec2> points = places_argument("route", route);
    const auto scene = terrain.cast<Scene>();
    const py::gil_scoped_release release;
    return laid(points, scene);
  }
  const Points rows = points_argument("route", array);
  std::vector<Vec3> points;
  for (Index i = 0; i < rows.rows(); ++i) points.emplace_back(rows.view().row(i));
  const py::gil_scoped_release release;
  return free(points);
}

Pipeline pipeline(const ArrayLike& route, double diameter, const OptionalScene& terrain,
                  const ArrayLike& burial, const OptionalArray& spans, double span_gap, double sag,
                  double anode_spacing, double anode_length, double anode_thickness,
                  double joint_spacing, double joint_length, double joint_recess, double step,
                  int sides, int num_threads) {
  PipelineOptions o;
  o.burial = burial_argument(burial);
  o.spans = spans_argument(spans);
  o.span_gap = span_gap;
  o.sag = sag;
  o.anode_spacing = anode_spacing;
  o.anode_length = anode_length;
  o.anode_thickness = anode_thickness;
  o.joint_spacing = joint_spacing;
  o.joint_length = joint_length;
  o.joint_recess = joint_recess;
  o.step = step;
  o.sides = sides;
  o.num_threads = num_threads;
  return along_route(
      route, terrain,
      [&](const std::vector<Vec2>& points, const Scene& scene) {
        return make_pipeline(points, scene, diameter, o);
      },
      [&](const std::vector<Vec3>& points) { return make_pipeline(points, diameter, o); });
}

Pipeline cable(const ArrayLike& route, double diameter, const OptionalScene& terrain,
               const ArrayLike& burial, double sag, double slack, double slack_wavelength,
               std::uint64_t seed, double step, int sides, int num_threads) {
  CableOptions o;
  o.burial = burial_argument(burial);
  o.sag = sag;
  o.slack = slack;
  o.slack_wavelength = slack_wavelength;
  o.seed = seed;
  o.step = step;
  o.sides = sides;
  o.num_threads = num_threads;
  return along_route(
      route, terrain,
      [&](const std::vector<Vec2>& points, const Scene& scene) {
        return make_cable(points, scene, diameter, o);
      },
      [&](const std::vector<Vec3>& points) { return make_cable(points, diameter, o); });
}

template <class Member>
auto column(Member member) {
  return [member](const Pipeline& line) { return to_numpy(line.*member); };
}

void bind_pipeline_class(py::module_& module) {
  py::class_<Pipeline>(module, "Pipeline",
                       "A pipeline or cable as it lies; its N stations are rings of the mesh.")
      .def_readonly(
          "mesh", &Pipeline::mesh,
          "Closed TriangleMesh; a vertex attribute ``kp`` is the way along the route [m].")
      .def_property_readonly(
          "center", [](const Pipeline& line) { return to_numpy(Points(line.center)); },
          "(N, 3) middle line [m].")
      .def_property_readonly("kp", column(&Pipeline::kp),
                             "(N,) along the route [m], horizontal where laid on a terrain.")
      .def_property_readonly("bottom", column(&Pipeline::bottom),
                             "(N,) height of the terrain below [m], NaN without one.")
      .def_property_readonly("burial", column(&Pipeline::burial),
                             "(N,) underside below the bottom [m], 0 or more; NaN without terrain.")
      .def_property_readonly("gap", column(&Pipeline::gap),
                             "(N,) underside above the bottom [m], 0 or more; NaN without terrain.")
      .def_property_readonly(
          "span",
          [](const Pipeline& line) {
            py::array_t<bool> result(static_cast<py::ssize_t>(line.span.size()));
            std::copy(line.span.begin(), line.span.end(), result.mutable_data());
            result.attr("setflags")(py::arg("write") = false);
            return result;
          },
          "(N,) in a given span, or above the bottom by more than a tenth of the diameter.")
      .def("__repr__", [](const Pipeline& line) {
        return "Pipeline(" + std::to_string(line.kp.size()) + " stations, " +
               to_text(std::round(100.0 * line.kp.back()) / 100.0) + " m)";
      });
}

}  // namespace

void bind_pipeline(py::module_& module) {
  bind_pipeline_class(module);
  const PipelineOptions p;
  module.def("make_pipeline", &pipeline, py::arg("route"), py::arg("diameter"),
             py::arg("terrain") = py::none(), py::kw_only(), py::arg("burial") = 0.0,
             py::arg("spans") = py::none(), py::arg("span_gap") = p.span_gap,
             py::arg("sag") = p.sag, py::arg("anode_spacing") = p.anode_spacing,
             py::arg("anode_length") = p.anode_length,
             py::arg("anode_thickness") = p.anode_thickness,
             py::arg("joint_spacing") = p.joint_spacing, py::arg("joint_length") = p.joint_length,
             py::arg("joint_recess") = p.joint_recess, py::arg("step") = p.step,
             py::arg("sides") = p.sides, py::arg("num_threads") = p.num_threads, kMakePipelineDoc);
  const CableOptions c;
  module.def("make_cable", &cable, py::arg("route"), py::arg("diameter"),
             py::arg("terrain") = py::none(), py::kw_only(), py::arg("burial") = 0.0,
             py::arg("sag") = c.sag, py::arg("slack") = c.slack,
             py::arg("slack_wavelength") = c.slack_wavelength, py::arg("seed") = c.seed,
             py::arg("step") = c.step, py::arg("sides") = c.sides,
             py::arg("num_threads") = c.num_threads, kMakeCableDoc);
}

}  // namespace bathyal::python
