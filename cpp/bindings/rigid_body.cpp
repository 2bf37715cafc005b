// SPDX-License-Identifier: BSD-3-Clause
#include "rigid_body.hpp"

#include <vector>

#include "bathyal/base/error.hpp"
#include "bindings.hpp"

namespace bathyal::python {
namespace {

constexpr const char* kRigidBodyDoc =
    R"(What a body weighs, how it resists turning, and the water it displaces.

All of it in one frame, which the owner names: of a link its own, of a vehicle the vehicle's.

Parameters
----------
mass : float
    [kg]; 0 is unknown.
center_of_mass : (3,) array
    [m]
inertia : (3, 3) array, optional
    About the centre of mass [kg m²]; zero, unknown, unless given.
volume : float
    Displaced water [m³]; 0 is unknown.
center_of_buoyancy : (3,) array
    [m]

Raises
------
ValueError
    For a mass or volume that is negative or not finite, and an inertia that no body has: not
    symmetric, or with a principal moment that is negative or above the sum of the two others (by
    more than a thousandth of their sum: files round).

Examples
--------
>>> import bathyal
>>> hull = bathyal.RigidBody(20, volume=0.02)
>>> lead = bathyal.RigidBody(5, center_of_mass=(0, 0, -0.5))
>>> hull.combined(lead).center_of_mass
array([ 0. ,  0. , -0.1])
)";

}  // namespace

py::array to_numpy(const Eigen::Matrix3d& matrix) {
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> rows = matrix;
  return to_numpy(std::vector<double>(rows.data(), rows.data() + 9), {3});
}

RigidBody rigid_body_arguments(double mass, const py::object& center_of_mass,
                               const py::object& inertia, double volume,
                               const py::object& center_of_buoyancy) {
  RigidBody body;
  body.mass = mass;
  body.center_of_mass = vector_argument("center_of_mass", center_of_mass);
  if (!inertia.is_none()) body.inertia = square_argument("inertia", inertia, 3);
  body.volume = volume;
  body.center_of_buoyancy = vector_argument("center_of_buoyancy", center_of_buoyancy);
  body.check();
  return body;
}

void bind_rigid_body(py::module_& module) {
  const RigidBody defaults;
  py::class_<RigidBody> cls(module, "RigidBody", kRigidBodyDoc);
  cls.def(py::init([](double mass, const ArrayLike& center_of_mass, const OptionalArray& inertia,
                      double volume, const ArrayLike& center_of_buoyancy) {
            return rigid_body_arguments(mass, center_of_mass, inertia, volume, center_of_buoyancy);
          }),
          py::arg("mass") = defaults.mass, py::kw_only(),
          py::arg("center_of_mass") = py::make_tuple(0, 0, 0), py::arg("inertia") = py::none(),
          py::arg("volume") = defaults.volume,
          py::arg("center_of_buoyancy") = py::make_tuple(0, 0, 0))
      .def_readonly("mass", &RigidBody::mass, "[kg]; 0 is unknown.")
      .def_property_readonly(
          "center_of_mass", [](const RigidBody& b) { return to_numpy(b.center_of_mass); },
          "(3,) [m].")
      .def_property_readonly(
          "inertia", [](const RigidBody& b) { return to_numpy(b.inertia); },
          "(3, 3) about the centre of mass [kg m²].")
      .def_readonly("volume", &RigidBody::volume, "Displaced [m³]; 0 is unknown.")
      .def_property_readonly(
          "center_of_buoyancy", [](const RigidBody& b) { return to_numpy(b.center_of_buoyancy); },
          "(3,) [m].")
      .def(
          "in_frame",
          [](const RigidBody& body, const OptionalArray& pose) {
            const Pose new_from_body = pose_argument("pose", pose);
            check_rigid("pose", new_from_body);
            return in_frame(body, new_from_body);
          },
          py::arg("pose"), "The body in the frame of `pose` (4, 4), new_from_body.")
      .def("combined", &combined, py::arg("other"),
           "This body and another of the same frame, fixed to each other (Steiner).")
      .def("__repr__", [](const RigidBody& b) {
        return "RigidBody(" + to_text(b.mass) + ", volume=" + to_text(b.volume) + ")";
      });
  cls.def(py::pickle(
      [](const RigidBody& b) {
        return py::make_tuple(b.mass, to_numpy(b.center_of_mass), to_numpy(b.inertia), b.volume,
                              to_numpy(b.center_of_buoyancy));
      },
      [](const py::tuple& state) {
        return rigid_body_arguments(state[0].cast<double>(), state[1], state[2],
                                    state[3].cast<double>(), state[4]);
      }));
}

}  // namespace bathyal::python
