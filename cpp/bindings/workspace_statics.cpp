// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>

#include "arrays.hpp"
#include "bathyal/base/error.hpp"
#include "bathyal/base/text.hpp"
#include "bathyal/workspace/sampling/static_trim.hpp"
#include "bathyal/workspace/sampling/vehicle_wrench.hpp"
#include "workspace_class.hpp"
#include "workspace_sampling_docs.hpp"

namespace bathyal::python {
namespace {

/// A trim, and whether it is of a single posture.
struct TrimRows {
  StaticTrim trim;
  bool single = false;
};

/// Rates of coordinates, of q's shape; nothing of None.
std::optional<JointMatrix> rates_argument(std::string_view name, const py::object& object,
                                          const Rows& q) {
  if (object.is_none()) return std::nullopt;
  Rows rates = python::rows_argument(name, object, q.table.cols());
  if (rates.table.rows() != q.table.rows()) {
    throw_argument(name, std::to_string(q.table.rows()) + " rows, as q has",
                   std::to_string(rates.table.rows()));
  }
  return std::move(rates.table);
}

py::array wrench_python(const Workspace& ws, const ArrayLike& q, const OptionalArray& contact,
                        const ArrayLike& time, const OptionalArray& velocity,
                        const OptionalArray& acceleration, const ArrayLike& gravity,
                        double water_density, int num_threads) {
  const Rows rows = rows_argument("q", q, ws.arm().size());
  const Rows pushes = contact.is_none() ? Rows{} : rows_argument("contact", contact, 6);
  const std::vector<double> times = coordinates_argument("time", time, rows.table.rows());
  const std::optional<JointMatrix> speeds = rates_argument("velocity", velocity, rows);
  const std::optional<JointMatrix> changes = rates_argument("acceleration", acceleration, rows);
  WrenchOptions options;
  options.gravity = vector_argument("gravity", gravity);
  options.water_density = water_density;
  options.time = times;
  if (speeds) options.velocity = &*speeds;
  if (changes) options.acceleration = &*changes;
  options.num_threads = num_threads;
  std::vector<double> wrenches;
  {
    const py::gil_scoped_release release;
    const Wrenches contacts(pushes.table.data(), pushes.table.rows(), 6);
    wrenches = vehicle_wrench(ws, joint_view(rows), contacts, options);
  }
  return to_numpy(std::move(wrenches), rows.single, {6});
}

py::array momentum_python(const Workspace& ws, const ArrayLike& q, const ArrayLike& velocity,
                          int num_threads) {
  const Rows rows = rows_argument("q", q, ws.arm().size());
  const Rows speeds = rows_argument("velocity", velocity, ws.arm().size());
  std::vector<double> momenta;
  {
    const py::gil_scoped_release release;
    momenta = arm_momentum(ws, joint_view(rows), joint_view(speeds), num_threads);
  }
  return to_numpy(std::move(momenta), rows.single, {6});
}

/// A number of a single posture, (N,) of several.
auto trim_values(std::vector<double> StaticTrim::*member) {
  return [member](const TrimRows& t) { return numbers_of_rows(t.trim.*member, t.single); };
}

}  // namespace

void bind_static_trim(py::module_& module) {
  py::class_<TrimRows>(module, "StaticTrim", workspace_docs::kTrim)
      .def_property_readonly(
          "roll", trim_values(&StaticTrim::roll),
          "About x [rad], −π to π; positive is starboard down. nan where neutral.")
      .def_property_readonly(
          "pitch", trim_values(&StaticTrim::pitch),
          "About y [rad], −π/2 to π/2; positive is nose down. nan where neutral.")
      .def_property_readonly(
          "status",
          [](const TrimRows& t) {
            std::vector<std::string> names;
            for (const TrimStatus status : t.trim.status) names.emplace_back(to_text(status));
            return texts(names, t.single);
          },
          "\"upright\"; \"turned_over\", where what is at rest has the vehicle's z axis downwards; "
          "\"neutral\", where every attitude is at rest.")
      .def_property_readonly(
          "righting", trim_values(&StaticTrim::righting),
          "Moment that turns the vehicle back from a right angle off this attitude [N m]; from a "
          "small angle this times the angle.")
      .def_property_readonly("buoyancy", trim_values(&StaticTrim::buoyancy),
                             "Buoyancy less weight of all [N]; below 0 it sinks.")
      .def("__repr__", [](const TrimRows& t) {
        if (t.single) {
          return "StaticTrim(roll=" + bathyal::to_text(t.trim.roll.front()) +
                 ", pitch=" + bathyal::to_text(t.trim.pitch.front()) + ")";
        }
        return "StaticTrim(" + std::to_string(t.trim.roll.size()) + " postures)";
      });
}

void add_statics(py::class_<Workspace>& cls) {
  const WrenchOptions wrench;
  const TrimOptions trim;
  cls.def("wrench", &wrench_python, py::arg("q"), py::kw_only(), py::arg("contact") = py::none(),
          py::arg("time") = 0.0, py::arg("velocity") = py::none(),
          py::arg("acceleration") = py::none(),
          py::arg("gravity") =
              py::make_tuple(wrench.gravity.x(), wrench.gravity.y(), wrench.gravity.z()),
          py::arg("water_density") = wrench.water_density,
          py::arg("num_threads") = wrench.num_threads, workspace_docs::kWrench)
      .def("momentum", &momentum_python, py::arg("q"), py::arg("velocity"), py::kw_only(),
           py::arg("num_threads") = 0, workspace_docs::kMomentum)
      .def(
          "static_trim",
          [](const Workspace& ws, const ArrayLike& q, double gravity, double water_density,
             int num_threads) {
            const Rows rows = rows_argument("q", q, ws.arm().size());
            const py::gil_scoped_release release;
            return TrimRows{
                static_trim(ws, joint_view(rows), {gravity, water_density, num_threads}),
                rows.single};
          },
          py::arg("q"), py::kw_only(), py::arg("gravity") = trim.gravity,
          py::arg("water_density") = trim.water_density, py::arg("num_threads") = trim.num_threads,
          workspace_docs::kStaticTrim);
}

}  // namespace bathyal::python
