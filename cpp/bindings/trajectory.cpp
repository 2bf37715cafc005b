// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory.hpp"

#include <pybind11/stl.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "bathyal/base/check.hpp"
#include "bathyal/base/error.hpp"
#include "bindings.hpp"

namespace bathyal::python {
namespace {

constexpr const char* kTrajectoryDoc = R"(A pose over time.

Between two times the origin moves on a straight line and the frame turns at a constant rate about
one axis; before the first and after the last time it rests.

Parameters
----------
time : (K,) array
    Rising [s].
pose : (K, 4, 4) array
    target_from_source at each time: of a vehicle, world_from_vehicle.

Raises
------
ValueError
    For no pose, times that do not rise, another count of poses, or one that is not rigid.

Examples
--------
>>> import bathyal, numpy
>>> pose = numpy.stack([numpy.eye(4), numpy.eye(4)])
>>> pose[1, 0, 3] = 2.0
>>> bathyal.Trajectory([0, 4], pose).at(1.0)[:3, 3]
array([0.5, 0. , 0. ])
)";

constexpr const char* kSampledDoc = R"(A trajectory from a function of time.

Parameters
----------
function : callable
    From the time [s] to the pose, (4, 4).
end, start, step : float
    First and last time, and the time between two calls [s]: between them the pose is interpolated.

Returns
-------
Trajectory
)";

std::vector<double> numbers(const Values& values) {
  return {values.data(), values.data() + values.rows()};
}

Trajectory sampled(std::string_view name, const py::object& function, double start, double end,
                   double step) {
  if (!(step > 0.0) || !(end > start) || !((end - start) / step < 1e6)) {
    throw_argument("step", "a step above 0 that divides a time span into less than 10⁶ parts",
                   to_text(step) + " s from " + to_text(start) + " to " + to_text(end));
  }
  std::vector<double> time;
  std::vector<Pose> poses;
  const auto count = static_cast<int>(std::ceil((end - start) / step - 1e-9));
  for (int i = 0; i <= count; ++i) {
    time.push_back(i == count ? end : start + step * i);
    const py::object pose = function(time.back());
    if (pose.is_none()) {
      throw_argument(name, "a function that gives a (4, 4) pose",
                     "None at " + to_text(time.back()));
    }
    poses.push_back(pose_argument(name, pose));
  }
  return {std::move(time), std::move(poses)};
}

}  // namespace

Trajectory trajectory_argument(std::string_view name, const py::object& object) {
  if (py::isinstance<Trajectory>(object)) return object.cast<Trajectory>();
  if (PyCallable_Check(object.ptr()) != 0) return sampled(name, object, 0.0, 600.0, 0.05);
  const Pose pose = pose_argument(name, object);
  check_rigid(name, pose);
  return pose;
}

void bind_trajectory(py::module_& module) {
  py::class_<Trajectory>(module, "Trajectory", kTrajectoryDoc)
      .def(py::init([](const ArrayLike& time, const ArrayLike& pose) {
             return Trajectory(numbers(values_argument("time", time)),
                               poses_argument("pose", pose));
           }),
           py::arg("time"), py::arg("pose"))
      .def_static(
          "sampled",
          [](const py::typing::Callable<ArrayLike(py::float_)>& function, double end, double start,
             double step) { return sampled("function", function, start, end, step); },
          py::arg("function"), py::arg("end"), py::kw_only(), py::arg("start") = 0.0,
          py::arg("step") = 0.05, kSampledDoc)
      .def_property_readonly(
          "time", [](const Trajectory& t) { return to_numpy(std::vector<double>(t.time())); },
          "(K,) rising [s].")
      .def_property_readonly(
          "pose", [](const Trajectory& t) { return to_numpy(t.pose()); },
          "(K, 4, 4) target_from_source.")
      .def(
          "at",
          [](const Trajectory& t, const ArrayLike& time) {
            const py::array given = array_argument("time", time, "a number or (N,) real numbers");
            const bool single = given.ndim() == 0;
            const Values times =
                values_argument("time", single ? given.attr("reshape")(1) : py::object(given));
            std::vector<Pose> poses;
            for (const double at : numbers(times)) {
              check_finite("time", at);
              poses.push_back(t.at(at));
            }
            const py::array rows = to_numpy(poses);
            return single ? py::array(rows[py::int_(0)]) : rows;
          },
          py::arg("time"),
          "The pose at a time [s], (4, 4); of (N,) times (N, 4, 4). Before the first and after the "
          "last it rests.")
      .def("__len__", [](const Trajectory& t) { return t.time().size(); })
      .def("__repr__",
           [](const Trajectory& t) {
             return "Trajectory(" + std::to_string(t.time().size()) + " poses, " +
                    to_text(t.time().front()) + " to " + to_text(t.time().back()) + " s)";
           })
      .def(py::pickle(
          [](const Trajectory& t) {
            return py::make_tuple(to_numpy(std::vector<double>(t.time())), to_numpy(t.pose()));
          },
          [](const py::tuple& state) {
            return Trajectory(numbers(values_argument("time", state[0])),
                              poses_argument("pose", state[1]));
          }));
}

}  // namespace bathyal::python
