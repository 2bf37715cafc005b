// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "bathyal/world/world.hpp"
#include "trajectory.hpp"

// What the bindings of the world share: motions and materials from Python, and what is pickled.

namespace bathyal::python {

/// A Python function of time as a motion: it takes the interpreter's lock to be called, copied or
/// dropped.
class FunctionMotion {
 public:
  explicit FunctionMotion(const py::object& function);
  Pose operator()(double time) const;
  const py::object& function() const { return *kept_; }

 private:
  std::shared_ptr<py::object> kept_;
};

/// None, a pose, a Trajectory, or a function of time.
Motion motion_argument(std::string_view name, const py::object& object);

using OptionalSediment = py::typing::Optional<Sediment>;

/// \throw std::invalid_argument as Material::check.
Material material_argument(const std::string& name, double strength, const OptionalArray& angle,
                           const OptionalArray& backscatter, const OptionalSediment& sediment);

/// Sediment, Material.
void bind_materials(py::module_& module);

/// All of a world: meshes and paints that objects share are held once.
py::tuple world_state(const World& world);
std::shared_ptr<World> world_from_state(const py::tuple& state);

}  // namespace bathyal::python
