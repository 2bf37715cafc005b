// SPDX-License-Identifier: BSD-3-Clause
#include "bathyal/world/world.hpp"

#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "arrays.hpp"
#include "bathyal/base/error.hpp"
#include "bindings.hpp"
#include "trajectory.hpp"
#include "world_docs.hpp"

namespace bathyal::python {
namespace {

/// Counts functions of time that ask worlds with functions of time: without a bound, one that asks
/// its own world would overflow the stack.
class Nested {
 public:
  Nested() {
    if (depth() == kMost) {
      throw_argument("pose", "a function that does not ask its own world", "one that does");
    }
    ++depth();
  }
  Nested(const Nested&) = delete;
  Nested& operator=(const Nested&) = delete;
  ~Nested() { --depth(); }

 private:
  static constexpr int kMost = 16;
  static int& depth() {
    thread_local int value = 0;
    return value;
  }
};

/// A Python function as a motion: it takes the interpreter's lock to be called, copied or dropped.
Motion function_motion(const py::object& function) {
  const auto kept = std::shared_ptr<py::object>(new py::object(function), [](py::object* held) {
    const py::gil_scoped_acquire lock;
    delete held;
  });
  return Motion(std::function<Pose(double)>([kept](double time) {
    const py::gil_scoped_acquire lock;
    const Nested nested;
    return given_pose_argument("pose", (*kept)(time));
  }));
}

Motion motion_argument(std::string_view name, const py::object& object) {
  if (!py::isinstance<Trajectory>(object) && PyCallable_Check(object.ptr()) != 0) {
    return function_motion(object);
  }
  return trajectory_argument(name, object);
}

std::vector<double> list_of(std::string_view name, const py::object& object) {
  const Values values = values_argument(name, object);
  return {values.data(), values.data() + values.rows()};
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
  const CloneOptions clones;
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
      .def(
          "add_clones",
          [](World& world, const TriangleMesh& mesh, std::int64_t count,
             const std::string& material, const std::string& name, std::uint64_t seed,
             const std::optional<std::array<double, 4>>& region, const std::array<double, 2>& scale,
             bool turned, double tilt, double sunk, double apart) {
            const py::gil_scoped_release unlocked;
            return world.add_clones(mesh, count, material, name,
                                    {seed, region, scale, turned, tilt, sunk, apart});
          },
          py::arg("mesh"), py::arg("count"), py::arg("material") = "rock",
          py::arg("name") = "clone", py::kw_only(), py::arg("seed") = clones.seed,
          py::arg("region") = py::none(), py::arg("scale") = clones.scale,
          py::arg("turned") = clones.turned, py::arg("tilt") = clones.tilt,
          py::arg("sunk") = clones.sunk, py::arg("apart") = clones.apart, world_docs::kAddClones)
      .def(
          "paint",
          [](World& world, const std::string& name, const ArrayLike& polygon,
             const std::string& material) {
            const auto corners = table_argument("polygon", polygon, 2);
            std::vector<Eigen::Vector2d> points;
            for (Index i = 0; i < corners.rows(); ++i) points.emplace_back(corners.row(i));
            return world.paint(name, points, material);
          },
          py::arg("name"), py::arg("polygon"), py::arg("material"), world_docs::kPaint)
      .def(
          "set_material",
          [](World& world, const std::string& name, double strength, const OptionalArray& angle,
             const OptionalArray& backscatter) {
            Material material;
            material.name = name;
            material.strength = strength;
            if (!angle.is_none()) material.angle = list_of("angle", angle);
            if (!backscatter.is_none()) {
              material.backscatter = list_of("backscatter", backscatter);
            }
            world.set_material(std::move(material));
          },
          py::arg("name"), py::arg("strength") = 1.0, py::kw_only(), py::arg("angle") = py::none(),
          py::arg("backscatter") = py::none(), world_docs::kSetMaterial)
      .def_property(
          "water", [](const World& world) { return world.water(); }, &World::set_water,
          "Water: of the sonars' and the vehicle's.")
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
