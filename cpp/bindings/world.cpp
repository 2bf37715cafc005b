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
#include "bathyal/base/check.hpp"
#include "bathyal/base/error.hpp"
#include "bindings.hpp"
#include "rays.hpp"
#include "trajectory.hpp"
#include "world_docs.hpp"
#include "world_parts.hpp"

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

Pose moved_by(const py::object& function, double time) {
  const py::gil_scoped_acquire lock;
  const Nested nested;
  return given_pose_argument("pose", function(time));
}

/// One of a world's objects, with the name of its material.
struct ListedObject {
  WorldObject object;
  std::string material;
};

py::typing::List<ListedObject> objects_of(const World& world) {
  py::typing::List<ListedObject> objects;
  for (const WorldObject& object : world.objects()) {
    const auto row = static_cast<std::size_t>(object.surface.whole);
    objects.append(ListedObject{object, world.materials()[row].name});
  }
  return objects;
}

using NameOrRow = py::typing::Union<py::str, py::int_>;
using NameOrMaterial = py::typing::Union<py::str, Material>;

Material material_of(const World& world, const NameOrRow& name) {
  if (py::isinstance<py::str>(name)) {
    return world
        .materials()[static_cast<std::size_t>(world.material_row(name.cast<std::string>()))];
  }
  const auto rows = static_cast<py::ssize_t>(world.materials().size());
  const std::string expected = "a name, or a row from 0 to " + std::to_string(rows - 1);
  if (PyIndex_Check(name.ptr()) == 0) {
    throw_argument("name", expected,
                   std::string(py::str(py::type::handle_of(name).attr("__name__"))));
  }
  const auto row = py::int_(name).cast<py::ssize_t>();
  if (row < 0 || row >= rows) throw_argument("name", expected, std::to_string(row));
  return world.materials()[static_cast<std::size_t>(row)];
}

void set_material(World& world, const NameOrMaterial& name, double strength,
                  const OptionalArray& angle, const OptionalArray& backscatter,
                  const OptionalSediment& sediment) {
  if (py::isinstance<py::str>(name)) {
    world.set_material(
        material_argument(name.cast<std::string>(), strength, angle, backscatter, sediment));
    return;
  }
  if (!py::isinstance<Material>(name)) {
    throw_argument("name", "a name or a Material",
                   std::string(py::str(py::type::handle_of(name).attr("__name__"))));
  }
  if (strength != 1.0 || !angle.is_none() || !backscatter.is_none() || !sediment.is_none()) {
    throw_argument("name", "a name where its law is given as well", "a Material");
  }
  world.set_material(name.cast<Material>());
}

/// Rows of the materials that were hit; `hits` are checked against the rows of the snapshot.
py::array materials_hit(const WorldSnapshot& snapshot, const Hits& hits) {
  const auto meshes = static_cast<Index>(snapshot.surfaces.size());
  std::vector<std::int32_t> rows;
  rows.reserve(hits.size());
  for (const RayHit& hit : hits) {
    if (hit.mesh >= 0 &&
        (hit.mesh >= meshes ||
         hit.triangle >=
             snapshot.scene.meshes()[static_cast<std::size_t>(hit.mesh)].triangle_count())) {
      throw_argument(
          "hits", "those of this snapshot's scene",
          "triangle " + std::to_string(hit.triangle) + " of row " + std::to_string(hit.mesh));
    }
    rows.push_back(snapshot.material(hit));
  }
  return to_numpy(std::move(rows));
}

void bind_snapshot(py::module_& module) {
  py::class_<WorldSnapshot>(module, "WorldSnapshot",
                            "A world at one moment: what rays meet, and of what it is made.")
      .def_readonly("scene", &WorldSnapshot::scene, "Scene: a row for each object.")
      .def_readonly("time", &WorldSnapshot::time, "[s]")
      .def_property_readonly(
          "materials",
          [](const WorldSnapshot& s) {
            py::typing::List<Material> materials;
            for (const Material& material : *s.materials) materials.append(material);
            return materials;
          },
          "Material of each row.")
      .def("material", &materials_hit, py::arg("hits"), world_docs::kHitMaterial)
      .def("__repr__", [](const WorldSnapshot& s) {
        return "WorldSnapshot(" + std::to_string(s.surfaces.size()) + " objects at " +
               to_text(s.time) + " s)";
      });
}

void bind_listed_object(py::module_& module) {
  py::class_<ListedObject>(module, "WorldObject",
                           "One of a world's objects, as it was when it was asked for.")
      .def_property_readonly(
          "name", [](const ListedObject& o) { return o.object.name; }, "Of the object.")
      .def_readonly("material", &ListedObject::material,
                    "Name of its material; painted regions have others.")
      .def_property_readonly(
          "mesh", [](const ListedObject& o) { return o.object.mesh; },
          "TriangleMesh: in its own frame.")
      .def_property_readonly(
          "scale", [](const ListedObject& o) { return o.object.scale; }, "Of the mesh.")
      .def_property_readonly(
          "moves", [](const ListedObject& o) { return o.object.pose.moves(); },
          "Whether its pose changes with time.")
      .def_property_readonly(
          "painted", [](const ListedObject& o) { return o.object.surface.of_triangle != nullptr; },
          "Whether regions of it have other materials.")
      .def(
          "pose",
          [](const ListedObject& o, double time) {
            check_finite("time", time);
            return to_numpy(o.object.pose.at(time));
          },
          py::arg("time") = 0.0, "(4, 4) world_from_object at a time [s].")
      .def("__repr__", [](const ListedObject& o) {
        return "WorldObject(\"" + o.object.name + "\", " + o.material +
               (o.object.pose.moves() ? ", moves)" : ")");
      });
}

}  // namespace

FunctionMotion::FunctionMotion(const py::object& function)
    : kept_(new py::object(function), [](py::object* held) {
        const py::gil_scoped_acquire lock;
        delete held;
      }) {}

Pose FunctionMotion::operator()(double time) const { return moved_by(*kept_, time); }

Motion motion_argument(std::string_view name, const py::object& object) {
  if (!py::isinstance<Trajectory>(object) && PyCallable_Check(object.ptr()) != 0) {
    return Motion(std::function<Pose(double)>(FunctionMotion(object)));
  }
  return trajectory_argument(name, object);
}

void bind_world(py::module_& module) {
  bind_materials(module);
  bind_snapshot(module);
  bind_listed_object(module);
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
      .def("set_material", &set_material, py::arg("name"), py::arg("strength") = 1.0, py::kw_only(),
           py::arg("angle") = py::none(), py::arg("backscatter") = py::none(),
           py::arg("sediment") = py::none(), world_docs::kSetMaterial)
      .def("material", &material_of, py::arg("name"), world_docs::kMaterialOf)
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
      .def_property_readonly("objects", &objects_of,
                             "WorldObject of each row of `scene`, as they are now.")
      .def("__len__", [](const World& world) { return world.objects().size(); })
      .def("__repr__",
           [](const World& world) {
             return "World(" + std::to_string(world.objects().size()) +
                    (world.objects().size() == 1 ? " object)" : " objects)");
           })
      .def(py::pickle(&world_state, &world_from_state));
}

}  // namespace bathyal::python
