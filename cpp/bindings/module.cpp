// SPDX-License-Identifier: BSD-3-Clause
#include "bindings.hpp"
#include "call_errors.hpp"
#include "hooks.hpp"

PYBIND11_MODULE(_core, module) {
  using namespace bathyal::python;
  module.doc() = "The engine. Its public names are those of the package bathyal.";
  bind_hooks(module);
  bind_base(module);
  bind_geometry(module);
  bind_mesh_report(module);
  bind_rigid_body(module);
  bind_shape(module);
  bind_trajectory(module);
  bind_soundings(module);
  bind_xtf(module);
  bind_terrain(module);
  bind_water_formulas(module);
  bind_water_profile(module);
  bind_water_motion(module);
  bind_water(module);
  bind_sound_path(module);
  bind_scene(module);
  bind_toolpath(module);
  bind_arm(module);
  bind_world(module);
  bind_survey(module);
  bind_generate(module);
  bind_sensors(module);
  bind_navigation_filter(module);
  bind_workspace(module);
  bind_vehicle(module);
  bind_devices(module);
  bind_vehicle_system(module);
  bind_behavior_tree(module);
  bind_mission(module);
  bind_protocol(module);
  bind_sonar(module);
  bind_sidescan(module);
  bind_navigation(module);
  bind_control(module);
  bind_uvms(module);
  bind_identify(module);
  bind_plan_touches(module);
  bind_verify(module);
  bind_diagnosis(module);
  guard_calls(module);
}
