// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/sonar/navigation.hpp"

#include <pybind11/stl.h>

#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "bathyal/base/text.hpp"
#include "bindings.hpp"
#include "enum_names.hpp"
#include "navigation_docs.hpp"
#include "trajectory.hpp"

namespace bathyal::python {
namespace {

using navigation_docs::fields;

/// The columns of a report, as arrays.
struct NavigationReport {
  py::array position, heading, pitch, roll, depth, speed;
};

NavigationReport navigation_report(const NavigationErrors& errors, const Trajectory& trajectory,
                                   const ArrayLike& time, std::optional<double> surface,
                                   std::uint64_t seed) {
  const Values times = values_argument("time", time);
  const std::vector<double> at(times.data(), times.data() + times.rows());
  ReportedNavigation got = report_navigation(errors, trajectory, at, surface, seed);
  return {to_numpy(Points(std::move(got.position))),
          to_numpy(std::move(got.heading)),
          to_numpy(std::move(got.pitch)),
          to_numpy(std::move(got.roll)),
          to_numpy(std::move(got.depth)),
          to_numpy(std::move(got.speed))};
}

py::array report_altitudes(const NavigationErrors& errors, const ArrayLike& altitude,
                           std::int64_t first, std::uint64_t seed) {
  const Values given = values_argument("altitude", altitude);
  std::vector<double> values;
  for (Index i = 0; i < given.rows(); ++i) {
    values.push_back(report_altitude(errors, given.data()[i], first + i, seed));
  }
  return to_numpy(std::move(values));
}

NavigationErrors errors_by_class(const std::string& name) {
  return enum_argument("name", name,
                       EnumNames<NavigationErrors (*)()>{{"inertial", inertial_navigation},
                                                         {"compass", compass_navigation},
                                                         {"usbl", usbl_navigation}})();
}

/// Those that are not as in the truth.
std::string shown_errors(const NavigationErrors& errors) {
  std::string text;
  for (const auto& field : fields()) {
    if (errors.*field.member == 0.0) continue;
    text +=
        (text.empty() ? "" : ", ") + std::string(field.name) + "=" + to_text(errors.*field.member);
  }
  return "NavigationErrors(" + text + ")";
}

using NumbersByName = py::KWArgs<py::float_>;

NavigationErrors replaced_errors(NavigationErrors errors, const py::dict& given) {
  for (const auto& [key, value] : given) {
    const std::string name = py::cast<std::string>(key);
    bool known = false;
    for (const auto& field : fields()) {
      if (name != field.name) continue;
      known = true;
      try {
        errors.*field.member = py::cast<double>(value);
      } catch (const py::cast_error&) {
        throw_argument(name, "a number", py::repr(value).cast<std::string>());
      }
    }
    if (known) continue;
    throw_argument(name, "a field of NavigationErrors, such as heading_bias (to_dict() lists them)",
                   "none of them");
  }
  errors.check();
  return errors;
}

py::typing::Dict<py::str, py::float_> errors_to_dict(const NavigationErrors& errors) {
  py::typing::Dict<py::str, py::float_> values;
  for (const auto& field : fields()) values[field.name] = errors.*field.member;
  return values;
}

}  // namespace

void bind_navigation(py::module_& module) {
  py::class_<NavigationReport>(module, "NavigationReport", navigation_docs::kReport)
      .def_readonly("position", &NavigationReport::position, "(P, 3) in the world [m].")
      .def_readonly("heading", &NavigationReport::heading, "(P,) clockwise from y [rad].")
      .def_readonly("pitch", &NavigationReport::pitch, "(P,) bow up [rad].")
      .def_readonly("roll", &NavigationReport::roll, "(P,) starboard down [rad].")
      .def_readonly("depth", &NavigationReport::depth,
                    "(P,) below the mean surface [m]; NaN without one.")
      .def_readonly("speed", &NavigationReport::speed, "(P,) over ground [m/s].");

  py::class_<NavigationErrors> cls(module, "NavigationErrors", navigation_docs::kErrors);
  cls.def(py::init([](const NumbersByName& given) { return replaced_errors({}, given); }))
      .def_static("preset", &errors_by_class, py::arg("name"), navigation_docs::kPreset)
      .def(
          "replace",
          [](const NavigationErrors& errors, const NumbersByName& given) {
            return replaced_errors(errors, given);
          },
          "Others with the given fields changed.")
      .def("report", &navigation_report, py::arg("trajectory"), py::arg("time"), py::kw_only(),
           py::arg("surface") = py::none(), py::arg("seed") = 0, navigation_docs::kReportCall)
      .def("report_altitude", &report_altitudes, py::arg("altitude"), py::kw_only(),
           py::arg("first") = 0, py::arg("seed") = 0,
           "(P,) what is reported of true altitudes [m], from ping `first` on; NaN stays NaN.")
      .def("to_dict", &errors_to_dict, "Every field's value by its name.")
      .def(
          "__eq__",
          [](const NavigationErrors& a, const NavigationErrors& b) {
            return errors_to_dict(a).equal(errors_to_dict(b));
          },
          py::is_operator())
      .def("__hash__",
           [](const NavigationErrors& e) { return py::hash(py::repr(errors_to_dict(e))); })
      .def("__repr__", &shown_errors)
      .def(py::pickle([](const NavigationErrors& e) { return errors_to_dict(e); },
                      [](const py::dict& given) { return replaced_errors({}, given); }));
  for (const auto& field : fields()) {
    cls.def_property_readonly(
        field.name, [member = field.member](const NavigationErrors& e) { return e.*member; },
        field.doc);
  }
}

}  // namespace bathyal::python
