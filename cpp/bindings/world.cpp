// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/world/world.hpp"

#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <memory>
#include <string>
#include <utility>

#include "arrays.hpp"
#include "bathyal/base/error.hpp"
#include "bindings.hpp"
#include "trajectory.hpp"
#include "world_docs.hpp"

namespace bathyal::python {
namespace {

/// A Python function as a motion: it takes the interpreter's lock to be called, copied or dropped.
Motion function_motion(const py::object& function) {
  const auto kept = std::shared_ptr<py::object>(new py::object(function), [](py::object* held) {
    const py::gil_scoped_acquire lock;
    delete held;
  });
  return Motion(std::function<Pose(double)>([kept](double time) {
    const py::gil_scoped_acquire lock;
    return pose_argument("pose", (*kept)(time));
  }));
}

Motion motion_argument(std::string_view name, const py::object& object) {
  if (!py::isinstance<Trajectory>(object) && PyCallable_Check(object.ptr()) != 0) {
    return function_motion(object);
  }
  return trajectory_argument(name, object);
}

void bind_snapshot(py::module_& module) {
  py::class_<WorldSnapshot>(module, "WorldSnapshot",
                            "A world at one moment: what rays meet, and of what it is made.")
      .def_readonly("scene", &WorldSnapshot::scene, "Scene: a row for each object.")
      .def_readonly("time", &WorldSnapshot::time, "[s]")
      .def("__repr__", [](const WorldSnapshot& s) {
        return "WorldSnapshot(" + std::to_string(s.surfaces.size()) + " objects at " +
               to_text(s.time) + " s)";
      });
}

}  // namespace

void bind_world(py::module_& module) {
  bind_snapshot(module);
  py::class_<World, std::shared_ptr<World>>(module, "World", world_docs::kWorld)
      .def(py::init())
      .def(
          "add",
          [](World& world, const TriangleMesh& mesh, const PoseLike& pose,
             const std::string& material, const std::string& name, double scale) {
            return world.add(mesh, motion_argument("pose", pose), material, name, scale);
          },
          py::arg("mesh"), py::arg("pose") = py::none(), py::arg("material") = "sand",
          py::arg("name") = "", py::kw_only(), py::arg("scale") = 1.0, world_docs::kAdd)
      .def(
          "at",
          [](const World& world, double time, int num_threads) {
            const py::gil_scoped_release unlocked;
            return world.at(time, num_threads);
          },
          py::arg("time") = 0.0, py::kw_only(), py::arg("num_threads") = 0, world_docs::kAt)
      .def_property_readonly(
          "scene",
          [](const World& world) {
            const py::gil_scoped_release unlocked;
            return world.at(0.0).scene;
          },
          "Scene: what rays see at time 0; row i is the object that was added as the ith.")
      .def_property_readonly(
          "materials",
          [](const World& world) {
            py::typing::List<py::str> names;
            for (const Material& material : world.materials()) names.append(material.name);
            return names;
          },
          "Names of the materials, in the order of the numbers in a ping's truth.")
      .def_property_readonly(
          "names",
          [](const World& world) {
            py::typing::List<py::str> names;
            for (const WorldObject& object : world.objects()) names.append(object.name);
            return names;
          },
          "Names of the objects, in the order of the scene's rows.")
      .def("__len__", [](const World& world) { return world.objects().size(); })
      .def("__repr__", [](const World& world) {
        return "World(" + std::to_string(world.objects().size()) +
               (world.objects().size() == 1 ? " object)" : " objects)");
      });
}

}  // namespace bathyal::python
