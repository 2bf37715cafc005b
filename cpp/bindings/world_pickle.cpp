// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>

#include <map>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "bathyal/base/error.hpp"
#include "world_parts.hpp"

namespace bathyal::python {
namespace {

/// A trajectory, or a function that pickle finds by its name.
py::object motion_state(const WorldObject& object) {
  if (!object.pose.is_function()) return py::cast(object.pose.trajectory());
  const py::object& function = object.pose.function().target<FunctionMotion>()->function();
  try {
    py::module_::import("pickle").attr("dumps")(function);
  } catch (py::error_already_set& error) {
    throw py::type_error("`pose` of \"" + object.name +
                         "\": expected a pose, a Trajectory or a function that pickle takes, "
                         "which it finds by its name in a module, got " +
                         std::string(py::repr(function)) + " (" +
                         std::string(py::str(error.value())) + ")");
  }
  return function;
}

/// Rows of what many objects share.
template <class Key>
class Shared {
 public:
  /// \param make What is kept of one that is new.
  template <class Make>
  std::size_t row(const Key& key, const Make& make) {
    const auto [found, added] = rows_.try_emplace(key, rows_.size());
    if (added) kept.append(make());
    return found->second;
  }

  py::list kept;

 private:
  std::map<Key, std::size_t> rows_;
};

py::list materials_state(const World& world) {
  py::list materials;
  for (const Material& material : world.materials()) materials.append(material);
  return materials;
}

}  // namespace

py::tuple world_state(const World& world) {
  Shared<std::pair<const void*, const void*>> meshes;
  Shared<const void*> paints;
  py::list objects;
  for (const WorldObject& object : world.objects()) {
    const TriangleMesh& mesh = object.mesh;
    const std::size_t row =
        meshes.row({mesh.shared_vertices().data(), mesh.shared_triangles().data()},
                   [&] { return py::cast(mesh); });
    py::object paint = py::none();
    if (const auto& painted = object.surface.of_triangle) {
      paint = py::cast(
          paints.row(painted.get(), [&] { return to_numpy(std::vector<std::int16_t>(*painted)); }));
    }
    objects.append(py::make_tuple(object.name, row, motion_state(object), object.scale,
                                  object.surface.whole, paint));
  }
  return py::make_tuple(meshes.kept, paints.kept, objects, materials_state(world),
                        py::cast(world.water()));
}

std::shared_ptr<World> world_from_state(const py::tuple& state) {
  const auto world = std::make_shared<World>();
  for (const py::handle& material : state[3]) world->set_material(material.cast<Material>());
  world->set_water(state[4].cast<Water>());
  std::vector<TriangleMesh> meshes;  // that nobody else writes to: objects share them
  for (const py::handle& mesh : state[0]) meshes.push_back(mesh.cast<TriangleMesh>().snapshot());
  std::vector<std::shared_ptr<const std::vector<std::int16_t>>> paints;
  for (const py::handle& paint : state[1]) {
    paints.push_back(
        std::make_shared<const std::vector<std::int16_t>>(paint.cast<std::vector<std::int16_t>>()));
  }
  for (const py::handle& one : state[2]) {
    const auto object = one.cast<py::tuple>();
    SurfaceMaterial surface{object[4].cast<std::int32_t>(), nullptr};
    if (!object[5].is_none()) surface.of_triangle = paints.at(object[5].cast<std::size_t>());
    world->add(WorldObject{object[0].cast<std::string>(), meshes.at(object[1].cast<std::size_t>()),
                           motion_argument("pose", object[2]), object[3].cast<double>(),
                           std::move(surface)});
  }
  return world;
}

}  // namespace bathyal::python
